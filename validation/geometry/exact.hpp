// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/ray.hpp"
#include "etendue/geometry/triangle.hpp"
#include "oracles/exact_intersections.hpp"

// Our types as the exact oracles want them.
namespace etendue::validation {

inline oracle::Point exact(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
inline oracle::Flat exact(const Vec2& v) {
  return {v.x(), v.y()};
}
inline std::array<oracle::Point, 3> exact(const Triangle& t) {
  return {exact(t.a), exact(t.b), exact(t.c)};
}

/// Largest coordinate in magnitude.
inline double largest(const Vec3& v) {
  return v.lpNorm<Eigen::Infinity>();
}

}  // namespace etendue::validation
