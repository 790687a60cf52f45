// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "etendue/assembly/exchange_matrix.hpp"
#include "etendue/assembly/row_closure.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// What a repair changed.
struct RepairReport {
  std::size_t changed = 0;                     ///< pairs with another value than before
  std::size_t beyond = 0;                      ///< of these, changed by more than their bound said they could be wrong
  std::size_t at_zero = 0;                     ///< held at zero
  double largest_change = 0;                   ///< of a factor
  std::size_t from = 0, to = 0;                ///< where
  double defect_before = 0, defect_after = 0;  ///< largest |1 − Σ_j F_ij| of the rows that see something
  std::size_t left_alone = 0;                  ///< rows that see nothing
};

struct RepairedExchanges {
  ExchangeMatrix matrix;
  RepairReport report;
};

/// A row that misses more of 1 than this is open, not wrong: closing it would invent walls.
inline constexpr double kOpenRow = 0.01;

/// The smallest change of the exchange areas that closes all rows and keeps A_i F_ij = A_j F_ji:
///
///     minimise Σ_{i<j} (X_ij − G_ij)²/w_ij   subject to   Σ_j X_ij = A_i,  X_ij ≥ 0               @eq IU.6-5, IU.6-6
///
/// with the bound of G_ij for its weight w_ij, so that factors known well hardly move. Its solution is X_ij = G_ij +
/// w_ij (λ_i + λ_j) with one number λ a row, found by conjugate gradients; pairs that would turn negative are held at 0.
/// Pairs known to be zero stay zero, rows that see nothing stay as they are.
///
/// Returns   the new matrix, its bounds grown by what was changed, and what was changed
/// Errors    not_converged: a row misses more than kOpenRow of 1, or no solution exists (λ cannot close it)
/// Source    weighted least squares as in Larsen and Howell 1986 and van Leersum 1989; the weights are ours
[[nodiscard]] Result<RepairedExchanges> repaired(const ExchangeMatrix& matrix, const RowClosure& closure);

}  // namespace etendue
