// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/interval.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// A box that holds a point or a direction; only what the enclosures of form factors need.
struct Interval3 {
  Interval x, y, z;

  Interval3() = default;
  Interval3(const Vec3& point) : x(point.x()), y(point.y()), z(point.z()) {}
  Interval3(const Interval& a, const Interval& b, const Interval& c) : x(a), y(b), z(c) {}

  Vec3 middle() const { return {x.middle(), y.middle(), z.middle()}; }
};

inline Interval3 operator-(const Interval3& a) {
  return {-a.x, -a.y, -a.z};
}
inline Interval3 operator+(const Interval3& a, const Interval3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Interval3 operator-(const Interval3& a, const Interval3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Interval3 operator*(const Interval& k, const Interval3& a) {
  return {k * a.x, k * a.y, k * a.z};
}
inline Interval dot(const Interval3& a, const Interval3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Interval3 cross(const Interval3& a, const Interval3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Interval square(const Interval3& a) {
  return square(a.x) + square(a.y) + square(a.z);
}
inline Interval norm(const Interval3& a) {
  return sqrt(square(a));
}

}  // namespace etendue
