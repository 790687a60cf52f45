// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/io/environment_reader.hpp"
#include "etendue/io/scene_files.hpp"
#include "etendue/io/scene_node.hpp"
#include "etendue/io/texture_reader.hpp"

namespace etendue {

/// The contents of the files as one scene. Everything wrong is reported; the scene is to be used only if nothing was.
[[nodiscard]] Scene assemble_scene(const LoadedFiles& files, TextureFiles& textures, EnvironmentFiles& environments,
                                   SceneErrors& errors);

}  // namespace etendue
