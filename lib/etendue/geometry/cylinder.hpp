// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The lateral surface of a finite right circular cylinder between the centres of its (open) ends.
struct Cylinder {
  Vec3 base;
  Vec3 top;
  double radius;
};

/// Bound on the error of t in units in its last place, in the domain named below; measured there:
/// validation/geometry/cylinder_test.cpp.
inline constexpr double kCylinderUlps = 1;

/// Nearest meeting of a ray with the wall of a cylinder.                                                    @eq IU.5.0
///
///     |n|² t² + 2 m·n t + |m|² − R²|A|² = 0,   v = O − base, A = top − base, m = v × A, n = D × A
///
/// Symbols   O, D origin and direction of the ray; R radius [length]
/// Domain    lengths between 2^-120 and 2^120. kCylinderUlps holds for origins within 10⁴ radii, rays that make an
///           angle above 10^-3 with the axis and pass the wall's silhouette at more than 2^-30 radii
/// Returns   the smallest t with max(0, t_min) < t < t_max whose point lies between the ends; normal outward also for
///           hits from inside; uv: u = turn around the axis from tangent_frame(A) in [0, 1), v = height, 0 at base, 1
///           at top
/// Hits      the ends are open; a tangent and a ray parallel to the axis are misses; an origin on the wall is not hit
///           at t = 0
/// Accuracy  all sums in DoubleDouble; point_error is a running bound that also covers what lies outside that domain.
///           Which side of an end a hit lies on is decided to 2^-90 of the height
/// Errors    ContractViolation where the radius is not positive, the ends coincide, or the direction is zero or not
///           finite
/// Source    elementary; the form of the discriminant as for Sphere
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Cylinder& cylinder);

}  // namespace etendue
