// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/double_double.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// A vector of such numbers; only what the intersections need.
struct DoubleDouble3 {
  DoubleDouble x, y, z;
};

inline DoubleDouble3 exact_difference(const Vec3& a, const Vec3& b) {
  return {exact_difference(a.x(), b.x()), exact_difference(a.y(), b.y()), exact_difference(a.z(), b.z())};
}

inline DoubleDouble3 widened(const Vec3& a) {
  return {a.x(), a.y(), a.z()};
}

inline DoubleDouble dot(const DoubleDouble3& a, const DoubleDouble3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline DoubleDouble dot(const DoubleDouble3& a, const Vec3& b) {
  return a.x * b.x() + a.y * b.y() + a.z * b.z();
}

inline DoubleDouble3 cross(const DoubleDouble3& a, const DoubleDouble3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// a + t b, each component rounded once at the end.
inline Vec3 rounded_along(const DoubleDouble3& a, const DoubleDouble& t, const Vec3& b) {
  return {rounded(a.x + t * b.x()), rounded(a.y + t * b.y()), rounded(a.z + t * b.z())};
}

}  // namespace etendue
