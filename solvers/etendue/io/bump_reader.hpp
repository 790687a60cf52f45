// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/io/scene_node.hpp"

namespace etendue {

/// The "bump" of a material. What is wrong is reported; `scale` leads from lengths of the file to those of the scene.
[[nodiscard]] std::optional<MaterialBump> read_bump(const SceneNode& node, double scale);

}  // namespace etendue
