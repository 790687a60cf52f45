// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/bounded.hpp"
#include "etendue/core/result.hpp"
#include "etendue/linear/gaussian_elimination.hpp"
#include "etendue/radiosity/solve.hpp"

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
  double backward_error = 0;  ///< componentwise, relative: RadiosityJudgement
};

/// The matrix I − diag(ρ) F, each entry rounded once or twice.                            @eq IU.6-9, IU.6.3x
[[nodiscard]] Eigen::MatrixXd radiosity_matrix(Eigen::MatrixXd form_factors, const Eigen::VectorXd& reflectance);

/// solve_radiosity() of solve.hpp for one channel and a matrix.
///
///     B_i = E_i + ρ_i Σ_j B_j F_ij                                                               @eq IU.6-7, IU.6-8
///
/// Symbols   factor_error: RadiosityRules; may_go_on: RadiosityGoal
/// Returns   B, its residual and bound; of an iteration, what it reached
/// Accuracy  max |B − exact B| ≤ bound, proved (NOTES.md)
/// Errors    those of solve.hpp; F that is not square. ErrorCode::stopped when it may not go on
[[nodiscard]] Result<RadiositySolution> solve_radiosity(const RadiositySystem& system, RadiositySolver solver,
                                                        double factor_error = Tolerance{}.relative,
                                                        const MayGoOn& may_go_on = {});

}  // namespace etendue
