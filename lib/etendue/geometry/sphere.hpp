// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The points at distance `radius` > 0 from `centre`.                                                       @eq IU.5-8
struct Sphere {
  Vec3 centre;
  double radius;
};

/// Bound on the error of t in units in its last place, from any origin; proved, NOTES.md §4.
inline constexpr double kSphereUlps = 1;

/// Nearest meeting of a ray with a sphere.
///
///     a t² + 2 b t + c = 0,   a = D·D, b = D·v, c = v·v − R², v = O − C             @eq IU.5-9, IU.5-10, IU.5-11, RT.8
///     b² − a c = a R² − |D × v|²
///
/// with μ = −b, λ = v·v and γ = b² − ac in the letters of the source, where D is a unit vector. The root whose two
/// terms cancel is taken as c over the other one (@eq G15).
///
/// Symbols   O, D origin and direction of the ray, C, R centre and radius of the sphere [length]
/// Domain    lengths (radius, |D|, |v|) between 2^-200 and 2^200
/// Returns   the smallest t with max(0, t_min) < t < t_max; point on the sphere, normal outward also for hits from
///           inside; uv: u = longitude/2π in [0, 1), v = colatitude from the south pole (−z)/π in [0, 1]
/// Hits      a tangent (γ = 0, decided exactly) is a miss; an origin on the sphere (c = 0) does not hit at t = 0
/// Accuracy  t within kSphereUlps, the decision exact, at any distance and however grazing: proved. DoubleDouble
///           decides, exact expansions where it cannot
/// Errors    ContractViolation where the radius is not positive, the direction zero, or any of them not finite
/// Source    [IU] 5.6.1, mended (docs/errata.md E14, E15, G15); the form of the discriminant: Haines et al. 2019
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Sphere& sphere);

}  // namespace etendue
