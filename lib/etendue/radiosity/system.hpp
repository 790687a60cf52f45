// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/bounded.hpp"
#include "etendue/core/result.hpp"
#include "etendue/linear/gaussian_elimination.hpp"

namespace etendue {

/// B = E + diag(ρ) F B for one colour channel.                                                     @eq IU.6-7 … IU.6-9
struct RadiositySystem {
  Eigen::MatrixXd form_factors;  ///< F, n × n; F(i, j) = F_ij
  Eigen::VectorXd reflectance;   ///< ρ, n
  Eigen::VectorXd emission;      ///< E [W/m²], n
};

/// Radiosities B and how good they are.
struct RadiositySolution {
  Eigen::VectorXd radiosity;  ///< B [W/m²], n
  double residual = 0;        ///< max_i |E_i + ρ_i Σ_j F_ij B_j − B_i| [W/m²]
  double bound = 0;           ///< proved: max_i |B_i − exact B_i| ≤ bound [W/m²], rounding included
  double backward_error = 0;  ///< componentwise, relative: upper bound for the solve with the rounded matrix of 6-9
};

enum class DirectSolver { gaussian_elimination, eigen_lu };

/// The matrix I − diag(ρ) F, each entry rounded once or twice.                            @eq IU.6-9, IU.6.3x
[[nodiscard]] Eigen::MatrixXd radiosity_matrix(const RadiositySystem& system);

/// The radiosities of one channel, and how far they can be from the exact solution of the system as given.
///
///     B_i = E_i + ρ_i Σ_j B_j F_ij                                                               @eq IU.6-7, IU.6-8
///
/// Symbols   factor_error: how far a given F_ij may be above the exact one, which is a share of power and at most 1;
///           without word of it, what form factors are computed to by default (Tolerance); may_go_on: asked before
///           each column that Gaussian elimination eliminates (Eigen's LU does not ask)
/// Returns   B, its residual and bound; Gaussian elimination gives the same bits from every compiler
/// Accuracy  max |B − exact B| ≤ bound, proved (NOTES.md): certificate.hpp
/// Errors    shapes that do not fit, no patch, non-finite entries, E < 0 (a patch emits or does not; absorption is ρ),
///           F_ij < 0 or above 1 + factor_error, ρ outside [0, 1) (at ρ = 1 the sum of the interreflections diverges:
///           E25), rows that cannot be shown to keep ρ_i Σ_j F_ij below 1, emissions so large that radiosities or their
///           bounds overflow; the message names the row (of F_ij the column too) and its
///           values. ErrorCode::stopped when it may not go on
[[nodiscard]] Result<RadiositySolution> solve_radiosity(const RadiositySystem& system, DirectSolver solver,
                                                        double factor_error = Tolerance{}.relative,
                                                        const MayGoOn& may_go_on = {});

}  // namespace etendue
