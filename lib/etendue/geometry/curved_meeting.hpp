// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/near_line.hpp"
#include "etendue/geometry/sign_changes.hpp"

// What the intersections with curved surfaces share; their users want torus.hpp, cone.hpp, ...
namespace etendue {

/// Parameters s of a NearLine between which a surface may lie.
struct ParameterRange {
  double low, high;
};

/// Where a line crosses a surface for the first time that its ray looks at.
struct CurvedMeeting {
  double t = 0;               ///< parameter along the ray
  Vec3 place = Vec3::Zero();  ///< x(s), relative to the line's centre, rounded once a coordinate
  double place_error = 0;     ///< bound on its distance from the true meeting point [length]
};

/// The first zero of `polynomial`, in the order of the ray, that `accepts` and the ray looks at.
///
/// A zero whose error reaches t = 0 counts as the ray's own origin: an origin on the surface is not hit.
template <class Accepts>
[[nodiscard]] std::optional<CurvedMeeting> first_meeting(const Ray& ray, const NearLine& line,
                                                         const BoundedPolynomial& polynomial,
                                                         const ParameterRange& range, Accepts accepts) {
  // Widened by what subtracting the shift rounds; looks_at() below has the last word.
  const double slack = 2 * kUnitRoundoff * std::abs(line.shift);
  const double low = std::max(range.low, std::max(0.0, ray.t_min) - line.shift - slack);
  const double high = std::min(range.high, ray.t_max - line.shift + slack);
  if (!(low < high)) return std::nullopt;
  const SignChanges changes = sign_changes(polynomial, low, high);
  for (std::size_t k = 0; k < changes.count; ++k) {
    const BoundedZero& zero = changes.zero[k];
    const DoubleDouble t = zero.x + line.shift;
    if (!looks_at(ray, rounded(t)) || rounded(t) <= zero.error || !accepts(zero)) continue;
    const Vec3 place = rounded_along(line.start, zero.x, ray.direction);
    const double along = zero.error + 2 * kDoubleDoubleError * std::abs(zero.x.high);
    return CurvedMeeting{rounded(t), place,
                         2 * line.start_error + along * ray.direction.norm() + kUnitRoundoff * place.lpNorm<1>()};
  }
  return std::nullopt;
}

/// Angle of (x, y) as a share of a turn, in [0, 1).
[[nodiscard]] inline double turn_of(double x, double y) {
  const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
  return turn < 0 ? turn + 1 : turn;
}

}  // namespace etendue
