// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/result.hpp"

namespace etendue {

/// B = E + diag(ρ) F B for one colour channel.                                                     @eq IU.6-7 … IU.6-9
struct RadiositySystem {
  Eigen::MatrixXd form_factors;  ///< F, n × n; F(i, j) = F_ij
  Eigen::VectorXd reflectance;   ///< ρ, n
  Eigen::VectorXd emission;      ///< E [W/m²], n
};

/// Radiosities B and how good they are.
struct RadiositySolution {
  Eigen::VectorXd radiosity;     ///< B [W/m²], n
  double residual = 0;           ///< max_i |E_i + ρ_i Σ_j F_ij B_j − B_i| [W/m²]
  double bound = 0;              ///< proved: max_i |B_i − exact B_i| ≤ bound [W/m²], rounding included
  double backward_error = 0;     ///< relative; of the linear solve
};

enum class DirectSolver { gaussian_elimination, eigen_lu };

/// Refuses shapes that do not fit, non-finite entries, F_ij < 0, ρ outside [0, 1), and rows with ρ_i Σ_j F_ij ≥ 1.
[[nodiscard]] Result<RadiositySolution> solve_radiosity(const RadiositySystem& system, DirectSolver solver);

}  // namespace etendue
