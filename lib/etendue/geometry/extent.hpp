// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// How large a chain of vertices is, and how large the numbers that describe it [length].
struct Extent {
  double coordinate = 0;  ///< largest coordinate
  double size = 0;        ///< largest distance from vertex 0 in any coordinate
};

[[nodiscard]] inline Extent extent_of(const std::vector<Vec3>& vertices) {
  Extent extent;
  for (const Vec3& v : vertices) {
    extent.coordinate = std::max(extent.coordinate, v.lpNorm<Eigen::Infinity>());
    extent.size = std::max(extent.size, (v - vertices.front()).lpNorm<Eigen::Infinity>());
  }
  return extent;
}

}  // namespace etendue
