// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include "oracles/obstructed_factor.hpp"

// Arithmetic of points, for the oracles of obstructed pairs.
namespace etendue::oracle {

inline Point sub(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point mix(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const Point& a) {
  return std::sqrt(dot(a, a));
}

/// Normal of the loop, of length twice its area.
inline Point newell(const Corners& c) {
  Point sum{0, 0, 0};
  for (std::size_t i = 1; i + 1 < c.size(); ++i) {
    const Point n = cross(sub(c[i], c[0]), sub(c[i + 1], c[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
  }
  return sum;
}

}  // namespace etendue::oracle
