// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "etendue/io/placement.hpp"
#include "etendue/io/scene_node.hpp"

namespace etendue {

/// Reads a sphere, disc, cylinder, cone, torus, quadric or bezier surface and places it in the world; nothing for other
/// types, or where something is wrong, which is reported.
[[nodiscard]] std::optional<Shape> read_curved_shape(const SceneNode& node, const std::string& type,
                                                     const Placement& placement);

/// A disc that closes the end of a cylinder or cone.
struct Cap {
  const char* end;  ///< "base" or "top"
  Disc disc;
};
/// The caps of a cylinder or cone, turned outward; an apex has none, nor have other shapes.
[[nodiscard]] std::vector<Cap> caps_of(const Shape& shape);

}  // namespace etendue
