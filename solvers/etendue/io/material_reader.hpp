// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/io/placement.hpp"
#include "etendue/io/texture_reader.hpp"

namespace etendue {

/// What is wrong is reported, and left at its default. `scale` leads from lengths of the file to those of the scene.
[[nodiscard]] Material read_material(const SceneNode& node, const std::string& name, double scale,
                                     TextureFiles& textures);

/// A light in world coordinates.
[[nodiscard]] std::optional<Light> read_light(const SceneNode& node, const Placement& placement);

}  // namespace etendue
