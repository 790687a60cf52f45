// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/radiosity/system.hpp"

namespace etendue {

/// B = E + diag(ρ) F B where each form factor is known between two numbers.                         @eq IU.6-7
struct EnclosedRadiositySystem {
  Eigen::MatrixXd lower, upper;  ///< 0 ≤ lower(i, j) ≤ F_ij ≤ upper(i, j) ≤ 1
  Eigen::VectorXd reflectance;   ///< ρ, n, the exact numbers that the doubles stand for
  Eigen::VectorXd emission;      ///< E [W/m²], n, the same
};

/// Two vectors with every radiosity between them.
struct RadiosityEnclosure {
  Eigen::VectorXd lower, upper;  ///< [W/m²]
};

/// Encloses the radiosities of every system whose form factors lie between the two matrices, the exact ones among them.
///
///     lower ≤ (I − diag(ρ) F_lower)⁻¹ E ≤ B ≤ (I − diag(ρ) F_upper)⁻¹ E ≤ upper
///
/// Returns   the enclosure; its width is what the factors leave open, and the two residual bounds
/// Accuracy  proved: the solution rises with every factor (NOTES.md §5), both ends are solved to a proved residual bound
/// Errors    those of solve_radiosity(), with "lower" or "upper"; lower(i, j) > upper(i, j); ErrorCode::not_converged
///           where ρ_i Σ_j upper(i, j) cannot be shown to be below 1: the factors are known too loosely
[[nodiscard]] Result<RadiosityEnclosure> enclose_radiosity(const EnclosedRadiositySystem& system, DirectSolver solver,
                                                           const MayGoOn& may_go_on = {});

}  // namespace etendue
