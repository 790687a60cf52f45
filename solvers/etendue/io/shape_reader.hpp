// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "etendue/io/placement.hpp"
#include "etendue/io/scene_node.hpp"

namespace etendue {

/// Reads a shape of that type (one of object_types() but "group") and places it in the world.
/// Everything wrong is reported; then there is no shape.
[[nodiscard]] std::optional<Shape> read_shape(const SceneNode& node, const std::string& type,
                                              const Placement& placement);

/// Reads what shapes of any type may have, to report what is wrong with it: for an object whose type nobody knows.
void read_numbers_of_shapes(const SceneNode& node);

}  // namespace etendue
