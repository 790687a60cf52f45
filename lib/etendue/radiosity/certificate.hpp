// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/radiosity/system.hpp"

namespace etendue {

/// d_i = 1 − ρ_i Σ_j F_ij, rounded down: by how much row i of I − diag(ρ)F is diagonally dominant.  @eq IU.6-9
///
/// Returns   a lower bound on d_i, below it by at most γ_(2n+10) (1 + ρ_i Σ_j F_ij) (proved, NOTES.md §2); zero or
///           less means that the row cannot be shown to be dominant
[[nodiscard]] double dominance(const RadiositySystem& system, Eigen::Index row);

struct ResidualBound {
  double residual = 0;  ///< max_i |r_i|, as computed [W/m²]
  double bound = 0;     ///< max_j |B_j − exact B_j| ≤ bound [W/m²]
};

/// How far any vector, however it was found, can be from the solution of B = E + diag(ρ) F B.       @eq IU.6-7
///
///     ‖B − exact B‖∞ ≤ max_i |r_i| / (1 − ρ_i Σ_j F_ij),   r = E + diag(ρ) F B − B
///
/// Contract  sizes fit, F_ij ≥ 0 and ρ_i ≥ 0, E and B finite, dominance() > 0 for every row; all are checked
/// Returns   an infinite bound where the magnitudes of a row overflow: nothing is shown then
/// Accuracy  proved, the rounding of r, of the denominator and of the quotient enclosed: NOTES.md §1 and §2
[[nodiscard]] ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity);

/// The same where each F_ij is known to within factor_bounds(i, j) only: how far B can be from the solution of the
/// system with the exact form factors.
///
///     ‖B − exact B‖∞ ≤ max_i ( |r_i| + ρ_i Σ_j δ_ij |B_j| ) / (1 − ρ_i Σ_j (F_ij + δ_ij))
///
/// Contract  as above but for dominance, and δ_ij ≥ 0 (infinite: nothing is known of F_ij)
/// Returns   infinity where a row with F + δ cannot be shown to be dominant, or overflows
/// Accuracy  proved as far as δ is: NOTES.md §3
[[nodiscard]] ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity,
                                           const Eigen::MatrixXd& factor_bounds);

}  // namespace etendue
