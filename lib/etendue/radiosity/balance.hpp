// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/radiosity/system.hpp"

namespace etendue {

/// 1 − Σ_j F_ij for each row: what a patch loses through openings, or what the form factors err by.  @eq IU.6-6
///
/// Accuracy  |error| ≤ γ_n Σ_j F_ij, proved
[[nodiscard]] Eigen::VectorXd closure_defects(const Eigen::MatrixXd& form_factors);

/// max_ij |A_i F_ij − A_j F_ji|: how far the factors are from conserving étendue [m²].               @eq IU.6-5
[[nodiscard]] double reciprocity_defect(const Eigen::MatrixXd& form_factors, const Eigen::VectorXd& areas);

/// Where the emitted power goes [W]; with reciprocal form factors and a solved system
/// emitted = absorbed + escaped, and `defect` is the difference.                                     @eq IU.6-1
struct PowerBalance {
  double emitted = 0;   ///< Σ A_i E_i
  double absorbed = 0;  ///< Σ A_i (1 − ρ_i) Σ_j F_ij B_j
  double escaped = 0;   ///< Σ A_i B_i (1 − Σ_j F_ij): leaves through openings
  double defect = 0;    ///< emitted − absorbed − escaped
};

/// Contract  `areas` and `radiosity` have one entry a patch of `system`
[[nodiscard]] PowerBalance power_balance(const RadiositySystem& system, const Eigen::VectorXd& areas,
                                         const Eigen::VectorXd& radiosity);

/// Of one channel of a solved equation with areas, from the irradiances that came with the solution.
[[nodiscard]] PowerBalance power_balance(const RadiosityEquation& equation, const RadiosityReport& solution,
                                         Eigen::Index channel);

}  // namespace etendue
