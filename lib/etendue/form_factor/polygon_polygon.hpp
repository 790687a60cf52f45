// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/facing_pair.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// Unobstructed form factor F_12: the fraction of the power leaving `from` that arrives at `to`.
///
///     F_12 = 1/A_1  ∫_A1 ∫_A2  cos a_1 cos a_2 / (π r²)  dA_2 dA_1                            @eq IU.6-3, IU.6.2
///
/// Symbols   A_1, A_2 areas [m²]; r distance [m]; a_1, a_2 angles to the normals, their cosines clamped at 0 [rad]
/// Domain    any two planar polygons, convex or concave, apart, touching or piercing one another's planes. One-sided:
///           what lies behind the other's plane is cut off, two that only see backs, or lie in one plane, exchange 0.
///           Vertices that leave their polygon's plane count as they are: F is then that of any surface on the same
///           outline, and what of a bent polygon is within its bend of the other's plane counts as on it
/// Returns   value in [0, 1] and a bound on its absolute error; bitwise invariant under scaling by powers of two. The
///           bound says it where the tolerance was not reached
/// Accuracy  |value − F| ≤ bound, truncation proved, rounding counted: NOTES.md §2–4, 7. Measured over the 10,240 pairs
///           of validation/reference/pair_truths.txt in ten families: the bound holds in all, at every tolerance asked;
///           the value is right to 1e-12 in all. The bound reaches what is asked but for a few that are cut where
///           rounding has bent them. It holds for triangles that touch but for rounding (T-junctions, a vertex on an
///           edge, folds of 1 to 1e-16) against a closed form, too; folds down to 1e-6 reach 1e-12, flatter ones an
///           absolute 1e-23
/// Errors    ContractViolation for a negative tolerance; a Polygon cannot be degenerate (Polygon::make refuses)
/// Source    Sparrow 1963; Schröder and Hanrahan 1993 for coplanar edges
[[nodiscard]] Bounded form_factor(const Polygon& from, const Polygon& to, Tolerance tolerance = {});

/// The same for regions given by their boundaries, as checked by PlanarRegion: outline first, holes clockwise.
[[nodiscard]] Bounded form_factor(const Boundary& from, const Boundary& to, Tolerance tolerance);

}  // namespace etendue
