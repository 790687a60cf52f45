// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The lateral surface of a right circular cone between the centres of its (open) ends: a whole cone where one radius
/// is zero, a truncated one else.
struct Cone {
  Vec3 base;
  Vec3 top;
  double base_radius;
  double top_radius;
};

/// Bound on the error of t in units in its last place, in the domain named below; measured there:
/// validation/geometry/cone_test.cpp.
inline constexpr double kConeUlps = 1;

/// Greatest length of a cone in that domain, in its larger radii: beyond, digits of t are lost with the square of the
/// length, some 10^4 units of the last place at 2^26 (measured on rays that graze), and from 2^46 on hits.
inline constexpr double kSlenderestCone = 0x1p10;

/// Nearest meeting of a ray with the wall of a cone.                                                        @eq IU.5.0
///
///     |A|⁴ |x|² − |A|² (A·x)² = (R₀ |A|² + (R₁ − R₀) A·x)²,   x = P − base, A = top − base, 0 ≤ A·x ≤ |A|²
///
/// Symbols   R₀, R₁ radii at base and top [length], P a point of the wall
/// Domain    radii ≥ 0, one of them > 0; lengths between 2^-120 and 2^120, distance of the origin up to 2^40 of them.
///           kConeUlps holds for |A| up to kSlenderestCone larger radii, and rays that pass the silhouette at more than
///           2^-30 of the larger radius
/// Returns   the smallest t with max(0, t_min) < t < t_max whose point lies between the ends; normal outward also for
///           hits from inside, at an apex along the axis; uv: u = turn around the axis from tangent_frame(A) in [0, 1),
///           v = height, 0 at base, 1 at top
/// Hits      the ends are open; the apex belongs to the wall, and a ray that passes it within 2^-90 of the cone's size
///           hits it; a tangent is a miss, and so is a ray within the wall of a truncated cone along
///           one of its lines; an origin on the wall is not hit at t = 0
/// Accuracy  all in DoubleDouble; point_error is proved, also outside that domain. Which side of an end a hit lies on is
///           decided to 2^-90 of the height
/// Errors    ContractViolation where a radius is negative, both are zero, the ends coincide, or the direction is zero or
///           not finite
/// Source    elementary
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Cone& cone);

}  // namespace etendue
