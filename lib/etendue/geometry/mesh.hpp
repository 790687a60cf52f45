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

  Triangle triangle(std::size_t index) const {
    const auto& corner = triangles[index];
    return {vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]};
  }
};

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Mesh& mesh);

}  // namespace etendue
