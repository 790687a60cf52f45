// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "etendue/radiosity/solve.hpp"

namespace etendue {

/// B = E + diag(ρ) F B where every number is known between two.                                     @eq IU.6-7
struct EnclosedRadiosityEquation {
  std::shared_ptr<const FormFactors> factors_lower, factors_upper;  ///< 0 ≤ lower ≤ F_ij ≤ upper ≤ 1
  Eigen::MatrixXd reflectance_lower, reflectance_upper;             ///< around ρ, n × channels, in [0, 1)
  Eigen::MatrixXd emission_lower, emission_upper;                   ///< around E [W/m²], n × channels, not negative
  Eigen::VectorXd areas;              ///< A [m²], or none: only conjugate gradients need them
  std::vector<std::string> channels;  ///< as in RadiosityEquation
};

/// Two numbers for each patch and channel with the radiosity between them.
struct RadiosityEnclosure {
  Eigen::MatrixXd lower, upper;                       ///< [W/m²], n × channels
  RadiosityStatus status = RadiosityStatus::reached;  ///< the worse of both ends'; the enclosure holds whatever it is
};

/// Encloses the radiosities of every equation whose data lie between the two, the exact ones among them.
///
///     lower ≤ (I − diag(ρ_lower) F_lower)⁻¹ E_lower ≤ B ≤ (I − diag(ρ_upper) F_upper)⁻¹ E_upper ≤ upper
///
/// Returns   the enclosure: its width is what the data leave open, and the two residual bounds. Two solves
/// Accuracy  proved: the solution rises with every datum (NOTES.md §5), both ends are solved to a proved residual bound
/// Errors    those of solve_radiosity(), with "lower" or "upper"; a lower end above the upper one (of F in dense and sparse
///           matrices; operators are taken at their word); ErrorCode::not_converged where ρ_i Σ_j upper(i, j) cannot be
///           shown to be below 1: the data are known too loosely; ErrorCode::stopped
[[nodiscard]] Result<RadiosityEnclosure> enclose_radiosity(const EnclosedRadiosityEquation& equation,
                                                           const RadiosityGoal& goal);

/// The same for one channel and matrices, ρ and E being the exact numbers that the doubles stand for.
struct EnclosedRadiositySystem {
  Eigen::MatrixXd lower, upper;  ///< 0 ≤ lower(i, j) ≤ F_ij ≤ upper(i, j) ≤ 1
  Eigen::VectorXd reflectance;   ///< ρ, n
  Eigen::VectorXd emission;      ///< E [W/m²], n
};
[[nodiscard]] Result<RadiosityEnclosure> enclose_radiosity(const EnclosedRadiositySystem& system,
                                                           RadiositySolver solver, const MayGoOn& may_go_on = {});

}  // namespace etendue
