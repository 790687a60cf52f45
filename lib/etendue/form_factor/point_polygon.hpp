// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/facing_pair.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// Lambert's factor from a differential element to a polygon: the fraction of the element's power that arrives there.
///
///     F = (1/2π) Σ_i γ_i n · (b_i × a_i)/|b_i × a_i|                                          @eq IU.6-2, IU.6-10
///
/// Symbols   n the element's normal, a_i, b_i the ends of edge i seen from the element [length]; γ_i the angle between
///           them [rad]
/// Domain    point finite, normal of length one within 16 u (it is divided by its length), polygon simple, convex or concave; what lies behind the element's plane is cut off.
///           One-sided: an element behind the polygon's plane, or in it, receives 0; within the distance its vertices are
///           off that plane it receives 0 with a bound that says what it may miss
/// Returns   value in [0, 1] and a bound on its absolute error
/// Accuracy  |value − F| ≤ bound, counted in NOTES.md §1. The bound does not shrink with the distance d as F ~ A/d²
///           does: relatively it grows like u · d · perimeter/A
/// Errors    ContractViolation when the normal is not of unit length or the point not finite
/// Source    Lambert 1760; the angles by atan2, which keeps small and nearly straight ones
[[nodiscard]] Bounded point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon);

/// The same for a boundary as checked by PlanarRegion: outline first, holes clockwise.
[[nodiscard]] Bounded point_to_boundary(const Vec3& point, const Vec3& normal, const Boundary& boundary);

/// The bare sum for a loop given relative to the element, wholly above its horizon, running counter-clockwise as seen
/// from the element; negative for the other sense.
[[nodiscard]] Bounded lambert_sum(std::span<const Vec3> seen_from_element, const Vec3& normal);

}  // namespace etendue
