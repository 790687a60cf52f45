// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/bounded.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// Form factor F_12 where the polygons `blockers` stand in the way.
///
///     F_12 = 1/A_1  ∫_A1 ∫_A2  H_12 cos a_1 cos a_2 / (π r²)  dA_2 dA_1                      @eq IU.6-4
///
/// Symbols   A_1, A_2 areas [m²]; r distance [m]; a_1, a_2 angles to the normals [rad]; H_12 one where the two points
///           see one another, else zero
/// Domain    from, to: as form_factor(). Blockers convex, two-sided; those in from's or to's plane hide nothing, those
///           that touch are sound, those that do not meet the space between are found out and ignored
/// Returns   value in [0, form_factor(from, to)] and an estimate of its absolute error. Where the free factor is itself
///           below tolerance.absolute, half of it
/// Accuracy  the bound is that of form_factor() where nothing blocks, 0 where one blocker hides all; else an embedded
///           estimate, measured, not proved: NOTES.md §5 gives the rate at which it is violated. A gap between
///           blockers through which no node of the rule sees is overlooked, whatever the tolerance: compare with the
///           factor from the other side, as assembly does
/// Errors    none
/// Source    Heckbert 1992 and Drettakis and Fiume 1994 for the critical lines
[[nodiscard]] Bounded obstructed_form_factor(const Polygon& from, const Polygon& to, std::span<const Polygon> blockers,
                                             Tolerance tolerance = {});

/// point_to_polygon() past the convex, two-sided `blockers`. Exact but for rounding; the bound counts the rounding of
/// the visible parts' boundary only to first order.
[[nodiscard]] Bounded visible_point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon,
                                               std::span<const Polygon> blockers);

}  // namespace etendue
