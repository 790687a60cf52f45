// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/double_double3.hpp"
#include "etendue/geometry/ray.hpp"

// What the intersections with curved surfaces share; their users want torus.hpp, cone.hpp, ...
namespace etendue {

/// A ray's line, counted from near the point where it passes closest to a centre: coefficients of polynomials in its
/// parameter then grow with the surface's size and not with a power of the distance it is seen from.
///
///     x(s) = O + (shift + s) D − C = start + s D
struct NearLine {
  double shift = 0;        ///< t of the closest approach, rounded: any number serves
  DoubleDouble3 start;     ///< O + shift D − C
  double start_error = 0;  ///< bound on the error of each of its coordinates
  double distance = 0;     ///< |start|, rounded

  NearLine(const Ray& ray, const Vec3& centre);
};

}  // namespace etendue
