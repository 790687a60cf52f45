// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "etendue/form_factor/certified_outline.hpp"

namespace etendue {

/// What is known of the flux that blockers take, and what it took to know it.
struct HiddenFlux {
  Interval flux;          ///< A_1 (F_free − F) [scaled length²]
  std::int64_t work = 0;  ///< evaluations of one arc from one point
  bool enclosed = true;   ///< false: outlines touch but for rounding, and `flux` is that of such as do exactly
};

/// Encloses the part of the flux from pair.from to pair.to that convex, two-sided blockers keep away.
///
///     A_1 (F_free − F) = ∫_A1 ∫_A2  (1 − H_12) cos a_1 cos a_2 / (π r²)  dA_2 dA_1            @eq IU.6-4
///
/// The source is cut into cells in which the shadows' outlines on the receiver keep their corners, along the lines
/// where they change; there the integrand is analytic. A cell where that cannot be shown counts from nothing to all.
///
/// Domain    blockers scaled as the pair is, convex and flat, such as triangles
/// Returns   the enclosure; half its width is about `goal` unless `budget` was spent before
/// Accuracy  inclusion proved where `enclosed`: NOTES.md §11
/// Errors    none
/// Source    Heckbert 1992 and Drettakis and Fiume 1994 for the critical lines
[[nodiscard]] HiddenFlux hidden_flux(const EnclosedPair& pair, const std::vector<std::vector<Vec3>>& blockers,
                                     double goal, std::int64_t budget);

}  // namespace etendue
