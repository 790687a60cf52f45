// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "etendue/core/bounded.hpp"
#include "etendue/core/interval.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// How narrow an enclosure shall be, and how much may be spent on it.
struct CertifiedGoal {
  Tolerance tolerance{1e-9, 0};  ///< half the width ≤ max(absolute, relative · middle)
  std::int64_t work = 200'000;   ///< most evaluations of a point's or an edge's share, of about a microsecond each
};

/// What narrowed an enclosure last.
enum class EnclosedBy {
  integration,   ///< nothing is in the way: contour or area integral
  event_lines,   ///< the source cut along the lines where shadows change their form
  shadow_hulls,  ///< umbra and penumbra of parts of a surface
};

/// A form factor between two numbers.
struct CertifiedFactor {
  Interval factor;        ///< holds the factor; within [0, 1]
  bool reached = false;   ///< the goal was met
  std::int64_t work = 0;  ///< evaluations spent
  EnclosedBy by = EnclosedBy::integration;
  std::size_t blockers = 0;  ///< convex ones that could not be shown to stay out of the way
};

/// An interval that holds the unobstructed form factor F_12: every step is rounded outward, every remainder bounded.
///
///     F_12 = 1/A_1  ∫_A1 ∫_A2  cos a_1 cos a_2 / (π r²)  dA_2 dA_1                            @eq IU.6-3, IU.6.2
///
/// Symbols   A_1, A_2 areas [m²]; r distance [m]; a_1, a_2 angles to the normals, their cosines clamped at 0 [rad]
/// Domain    any two polygons, apart, touching or piercing one another's planes; lengths, without a common offset,
///           between 2^-150 and 2^150. One-sided: what lies behind the other's plane is cut off
/// Means     the exact numbers that the doubles stand for. A polygon's plane passes through its first vertex, across its
///           Newell sum; the other is cut by it, exactly; F_12 is the flux through the two outlines that remain, and A_1
///           half the length of the Newell sum. Of a flat polygon that is the factor; where rounding lifts vertices off
///           the plane it is that of any surface on the outline, and 0 where it would be less
/// Returns   the enclosure, what it took, and whether the goal was met: it never claims what it does not hold
/// Accuracy  inclusion proved: NOTES.md §10. Widths measured there: 1e-13 relatively near, 1e-14 far
/// Errors    ContractViolation for a negative tolerance or no work
/// Source    Sparrow 1963; truncation as in contour.hpp and area_rule.hpp, in intervals
[[nodiscard]] CertifiedFactor certified_form_factor(const Polygon& from, const Polygon& to,
                                                    const CertifiedGoal& goal = {});

/// The same past polygons that stand in the way.
///
///     F_12 = 1/A_1  ∫_A1 ∫_A2  H_12 cos a_1 cos a_2 / (π r²)  dA_2 dA_1                      @eq IU.6-4
///
/// Symbols   as above; H_12 one where the two points see one another, else zero
/// Domain    any number of two-sided blockers, convex or concave, apart from the two, touching, piercing or overlapping
///           one another. Those behind from's or to's plane, or in it, hide nothing, `from` and `to` themselves included
/// Means     the exact numbers, as above. Of a blocker whose corners rounding moved off its plane: from each point its
///           outline as seen from there, beyond its plane. One in from's or to's plane but for rounding that overlaps
///           it may hide all or nothing; the enclosure then holds both
/// Returns   the enclosure: by shadow hulls, which always give one, and where a few blockers are in the way also by event
///           lines, whose width falls faster. At worst from 0 to the unobstructed factor
/// Accuracy  inclusion proved: NOTES.md §11, §14; widths measured there
/// Errors    ContractViolation as above
[[nodiscard]] CertifiedFactor certified_form_factor(const Polygon& from, const Polygon& to,
                                                    std::span<const Polygon> blockers, const CertifiedGoal& goal = {});

}  // namespace etendue
