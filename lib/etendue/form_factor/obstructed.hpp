// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/blocker.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// What moved a value into its range.
enum class Clamp {
  none,
  to_zero,  ///< the computed value was negative
  to_free,  ///< it was larger than the free factor
};

/// An obstructed form factor, and how it came about.
struct ObstructedFormFactor : Bounded {
  Bounded free;  ///< without the blockers, at most min(1, A_2/A_1)
  Clamp clamp = Clamp::none;
  double clamped_by = 0;  ///< how far the value was moved; never more than the bound before
  int cells = 0;          ///< pieces of the source over which was integrated
  int evaluations = 0;    ///< points from which the receiver was looked at
  bool curved =
      false;  ///< cells were sampled that curves of three edges cross: the estimate rests on how far they were cut
  bool reached = true;  ///< false: the work limit came before the tolerance, and the bound says how far it got
};

/// Form factor F_12 where `blockers` stand in the way.
///
///     F_12 = 1/A_1  ∫_A1 ∫_A2  H_12 cos a_1 cos a_2 / (π r²)  dA_2 dA_1                      @eq IU.6-4
///
/// Symbols   A_1, A_2 areas [m²]; r distance [m]; a_1, a_2 angles to the normals [rad]; H_12 one where the two points
///           see one another, else zero
/// Domain    from, to: as form_factor(). Blockers: plates and convex solids, anywhere: those that touch are sound, those
///           in from's or to's plane hide nothing, those that do not meet the space between are found out
/// Returns   0 ≤ value ≤ free ≤ min(1, A_2/A_1), and a bound on its absolute error. Where the free factor is itself below
///           tolerance.absolute, half of it
/// Accuracy  the free part is bounded by proof. The outer integral is cut along every line where visibility changes
///           its form before a node is set, so no gap is too narrow to be found; its error is estimated from the
///           distance of the edges and the coefficients found: measured, NOTES.md §5
/// Errors    ContractViolation for a negative tolerance
/// Source    Heckbert 1992 and Drettakis and Fiume 1994 for the critical lines
[[nodiscard]] ObstructedFormFactor obstructed_form_factor(const Polygon& from, const Polygon& to,
                                                          std::span<const Blocker* const> blockers,
                                                          Tolerance tolerance = {});

/// The share of the tolerance that the free factor's proved error may use.
inline constexpr double kFreeShare = 0.1;
[[nodiscard]] constexpr Tolerance free_share(const Tolerance& whole) {
  return {kFreeShare * whole.relative, kFreeShare * whole.absolute};
}

/// The same where the free factor is known already, to kFreeShare of the tolerance.
[[nodiscard]] ObstructedFormFactor obstructed_form_factor(const Polygon& from, const Polygon& to,
                                                          std::span<const Blocker* const> blockers, Tolerance tolerance,
                                                          const Bounded& free);

/// The same for plates.
[[nodiscard]] ObstructedFormFactor obstructed_form_factor(const Polygon& from, const Polygon& to,
                                                          std::span<const Polygon> plates, Tolerance tolerance = {},
                                                          BlockingSides sides = BlockingSides::both);

/// point_to_polygon() past two-sided plates, each a simple polygon.
///
/// Accuracy  the bound counts the rounding of Lambert's sum and, for every plane that cuts, the lune by which its
///           rounding can turn it: NOTES.md §5
[[nodiscard]] Bounded visible_point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon,
                                               std::span<const Polygon> plates);

/// The same past any blockers.
///
/// Domain    the point inside of no solid; on one's face it looks out, and the solid hides nothing
[[nodiscard]] Bounded visible_point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon,
                                               std::span<const Blocker* const> blockers);

}  // namespace etendue
