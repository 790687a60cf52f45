// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "etendue/geometry/triangle.hpp"

namespace etendue {

/// Triangles over shared vertices.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vec2> texture = {};  ///< u, v of each vertex in a pattern; or none

  Triangle triangle(std::size_t index) const {
    const auto& corner = triangles[index];
    return {vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]};
  }
};

/// The nearest hit of any triangle, the first in order among equals; every triangle is tried.             @eq IU.5.0
/// Returns   as for Triangle; uv are its barycentric coordinates. No ray slips through a closed mesh
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Mesh& mesh);

}  // namespace etendue
