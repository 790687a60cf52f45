// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/box.hpp"
#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The points x of a closed box with f(x) = 0:
///
///     f(x) = y·Q y + 2 q·y + k,   y = x − C, C the box's centre
///
/// Ellipsoids, paraboloids, hyperboloids of one and two sheets, elliptic cones and cylinders, saddles, and pairs of
/// planes. Counting from the box's centre keeps the digits of a quadric that is far from the origin of coordinates.
struct Quadric {
  Mat3 square = Mat3::Identity();  ///< Q; only its symmetric part counts
  Vec3 linear = Vec3::Zero();      ///< q
  double constant = -1;            ///< k
  Box box;                         ///< what of the surface is there
};

/// Bound on the error of t in units in its last place, in the domain named below; measured there:
/// validation/geometry/quadric_test.cpp.
inline constexpr double kQuadricUlps = 1;

/// Nearest meeting of a ray with a quadric.                                                                 @eq IU.5.0
///
/// Domain    finite coefficients; lengths between 2^-120 and 2^120, distance of the origin up to 2^40 times the box's
///           size. kQuadricUlps holds where the ray crosses the surface at more than 2^-30 of the terms' curvature
/// Returns   the smallest t with max(0, t_min) < t < t_max whose point lies in the box; normal along the gradient of f
///           (outward where f grows outward), where that is zero (the apex of a cone) against the ray; uv: coordinates
///           along the box's first two axes, in half edges, so in [−1, 1]²
/// Hits      where f changes its sign: a tangent is a miss, and so is a surface on which f does not (a double plane); an
///           origin on the surface is not hit at t = 0
/// Accuracy  all in DoubleDouble; point_error is proved, also outside that domain. Whether a meeting is in the box is
///           decided to 2^-50 of its size
/// Errors    ContractViolation where a coefficient is not finite, an edge of the box not positive, or the direction is
///           zero or not finite
/// Source    elementary
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Quadric& quadric);

}  // namespace etendue
