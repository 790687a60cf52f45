// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "etendue/core/double_double.hpp"
#include "etendue/geometry/ray.hpp"

// What the watertight intersections share; their users want triangle.hpp, polygon.hpp.
namespace etendue {

/// t, moved along the ray only as far as keeps its point in the box [low, high], widened by `room` on all sides.
///
/// A ray that passes an edge within the rounding of the shear at a low angle meets the plane far outside the shape;
/// bounds() and the accelerators rely on every hit's point being near it.
///
/// Domain    the line passes through the widened box
[[nodiscard]] inline DoubleDouble kept_near(const Ray& ray, const DoubleDouble& t, const Vec3& low, const Vec3& high,
                                            double room) {
  const Vec3 point = ray.at(t.high);
  if ((point.array() >= low.array() - room).all() && (point.array() <= high.array() + room).all()) return t;
  double first = -std::numeric_limits<double>::infinity(), last = -first;
  for (int k = 0; k < 3; ++k) {
    const double d = ray.direction[k];
    if (d == 0) continue;
    const double one = (low[k] - room - ray.origin[k]) / d, two = (high[k] + room - ray.origin[k]) / d;
    first = std::max(first, std::min(one, two));
    last = std::min(last, std::max(one, two));
  }
  return std::max(first, std::min(t.high, last));
}

}  // namespace etendue
