// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/curved_view.hpp"

namespace etendue {

/// How exact an exchange area shall be, and what may be spent on it.
struct CurvedGoal {
  double relative = 1e-6;
  double absolute = 0;       ///< [length²]
  int most_views = 400'000;  ///< points from which it is looked, of some 10 µs each
};

/// An exchange area, and how it came about.
struct CurvedExchangeArea : Bounded {
  int views = 0;
  bool reached = true;  ///< false: the work limit came before the goal; the bound says how far it got
};

/// Exchange area A_1 F_12 of two surfaces of which any, or any blocker, may be round.
///
///     A_1 F_12 = ∫_A1 F_dA1→2 dA_1                                                     @eq IU.6-3, IU.6-4
///
/// Symbols   F_dA1→2 the factor from an element to what it sees: visible_point_to_patch()
/// Domain    as there. Flat sources have the smoothest integrand: the caller chooses which of the two is `from`
/// Returns   0 ≤ value ≤ min(A_1, A_2) and a bound
/// Accuracy  cells of the source are quartered until the sum of what rules of 5 and of 3 of their nodes differ by, row by row
///           and regardless of sign, is below the goal; before that, until no cell is wider than twice its distance
///           from the middle of anything round: an estimate, measured in NOTES.md §13
[[nodiscard]] CurvedExchangeArea curved_exchange(const CurvedPatch& from, const CurvedPatch& to,
                                                 std::span<const CurvedBlocker* const> blockers,
                                                 const CurvedGoal& goal = {});

}  // namespace etendue
