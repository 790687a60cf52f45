// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The points at distance `tube` from the circle of radius `ring` around `centre`, across `axis` (of any length).
struct Torus {
  Vec3 centre;
  Vec3 axis;
  double ring;  ///< R, radius of the circle [length]
  double tube;  ///< r, radius of the tube, 0 < r < R [length]
};

/// Bound on the error of t in units in its last place, in the domain named below; measured there:
/// validation/geometry/torus_test.cpp.
inline constexpr double kTorusUlps = 1;

/// Greatest R/r in that domain: from there on digits of t are lost with its fourth power, and from 2^46 on hits.
inline constexpr double kThinnestTorus = 0x1p26;

/// Nearest meeting of a ray with a torus.                                                                   @eq IU.5.0
///
///     (|x|² + R² − r²)² |A|² = 4R² (|x|² |A|² − (A·x)²),   x = start + sD, counted from near the closest approach
///
/// Symbols   A axis, R and r radii of ring and tube [length]; D direction of the ray
/// Domain    0 < r < R ≤ kThinnestTorus r, lengths between 2^-120 and 2^120, distance of the origin up to 2^40 R where
///           R ≤ 100 r, else up to 2^13 R (from afar thin tubes may be missed). kTorusUlps holds for
///           rays that pass the silhouette at more than 2^-30 of r
/// Returns   the smallest t with max(0, t_min) < t < t_max; normal outward also for hits from inside; uv: u = turn
///           around the axis from tangent_frame(A), v = turn around the tube from its outermost circle towards A, both
///           in [0, 1)
/// Hits      a tangent is a miss (decided where the polynomial's sign is certain, to about 2^-90 of R⁴); an origin on
///           the surface is not hit at t = 0
/// Accuracy  all in DoubleDouble, every sign change of the quartic between two zeros of its derivative; point_error is
///           proved, also outside that domain. Counts agree with Sturm's in exact arithmetic: tested
/// Errors    ContractViolation where 0 < tube < ring does not hold, the axis or the direction is zero or not finite
/// Source    elementary; counting the parameter from the closest approach: Haines, An Introduction to Ray Tracing, 1989
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Torus& torus);

}  // namespace etendue
