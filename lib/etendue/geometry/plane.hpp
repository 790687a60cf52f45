// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The points p with normal · (p − point) = 0; `normal` is a unit vector.
struct Plane {
  Vec3 point;
  Vec3 normal;
};

/// Bound on the error of t in units in its last place, wherever a ray meets something flat; proved, NOTES.md §3.
inline constexpr double kPlaneUlps = 1;

/// Where a ray meets a plane.
///
///     t = −(d + N·O)/(N·D) = N·(P − O)/(N·D)                                        @eq IU.5-12, IU.5-13, RT.12
///
/// Symbols   N, P normal and point of the plane; O, D origin and direction of the ray [length]
/// Domain    lengths between 2^-200 and 2^200; |N|² within kUnitNormal of 1; |D| between 2^-500 and 2^500
/// Returns   t with max(0, t_min) < t < t_max; the plane's normal, never flipped; uv: coordinates from `point` along
///           tangent_frame(normal), in scene units
/// Hits      a ray parallel to the plane or in it is a miss, an origin on the plane does not hit at t = 0 (both exact)
/// Accuracy  t within kPlaneUlps, the decision exact: proved. The plane is the one its stored doubles describe
/// Errors    ContractViolation where the normal is not a unit vector, or the direction zero or not finite
/// Source    [IU] 5.6.2
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Plane& plane);

}  // namespace etendue
