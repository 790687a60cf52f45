// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "etendue/geometry/polygon.hpp"

namespace etendue::validation {

inline Polygon polygon(std::vector<Vec3> vertices) {
  return Polygon::make(std::move(vertices)).value();
}

/// The parallelogram o, o + a, o + a + b, o + b; its front is where a × b points.
inline Polygon rectangle(const Vec3& o, const Vec3& a, const Vec3& b) {
  return polygon({o, o + a, o + a + b, o + b});
}

/// A rotation about no axis of the coordinates, and a shift: frames that hide nothing by being aligned.
inline Vec3 tilted(const Vec3& p) {
  static const Mat3 rotation =
      (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * Eigen::AngleAxisd(1.1, Vec3(-2, 1, 0.5).normalized()))
          .toRotationMatrix();
  return rotation * p + Vec3(0.3, -0.2, 0.9);
}

inline Polygon tilted(const Polygon& p) {
  std::vector<Vec3> placed;
  for (const Vec3& v : p.vertices()) placed.push_back(tilted(v));
  return polygon(std::move(placed));
}

}  // namespace etendue::validation
