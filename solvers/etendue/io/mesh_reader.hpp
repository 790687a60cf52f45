// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "etendue/io/scene_node.hpp"

namespace etendue {

/// An array of points, `fewest` to `most` of them.
[[nodiscard]] std::optional<std::vector<Vec3>> read_vertices(const SceneNode& node, std::size_t fewest,
                                                             std::size_t most);

/// Least extent of a triangle: the intersection's products of lengths lose no digits from here on (triangle.hpp).
inline constexpr double kLeastTriangle = 0x1p-120;

/// What keeps the triangle's corners from spanning an area that double arithmetic can see: "lie on one line".
[[nodiscard]] std::optional<std::string> fault_of_area(const Triangle& triangle);

/// The mesh of "vertices" with "triangles" and "quads" (each quad a b c d becomes a b c and a c d), in local
/// coordinates.
[[nodiscard]] std::optional<Mesh> read_mesh(const SceneNode& node);

}  // namespace etendue
