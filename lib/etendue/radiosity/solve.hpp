// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "etendue/linear/gaussian_elimination.hpp"
#include "etendue/radiosity/equation.hpp"

namespace etendue {

/// The ways to solve 6-7. Direct ones form I − diag(ρ)F, n² numbers; the others multiply by F only.
enum class RadiositySolver {
  gaussian_elimination,  ///< our own, one channel after the other                                     @eq IU.6-9
  eigen_lu,              ///< Eigen's blocked LU
  jacobi,                ///< B ← E + diag(ρ) F B: a bounce a step
  gauss_seidel,          ///< the same, each row with the rows before it already new: gathering
  southwell,  ///< the largest |r_j| A_j first: shooting                                   @eq IU.6-12, IU.6-13
  conjugate_gradients,  ///< on the symmetrised system, which needs areas and reciprocity (NOTES.md §6)
  gmres,                ///< Eigen's, restarted after 30 steps
  bicgstab,             ///< Eigen's
};

/// Their names on a command line: gauss, lu, jacobi, gauss-seidel, southwell, cg, gmres, bicgstab.
[[nodiscard]] const std::vector<std::string>& solver_names();
[[nodiscard]] std::optional<RadiositySolver> solver_named(std::string_view name);
[[nodiscard]] const std::string& name(RadiositySolver solver);
[[nodiscard]] constexpr bool is_direct(RadiositySolver solver) {
  return solver == RadiositySolver::gaussian_elimination || solver == RadiositySolver::eigen_lu;
}

/// What is asked of a solution.
struct RadiosityGoal {
  RadiositySolver solver = RadiositySolver::gaussian_elimination;
  double tolerance = 1e-10;           ///< bound ≤ tolerance · max_i |B_i|, each channel by itself
  Eigen::Index most_steps = 100'000;  ///< of an iteration
  RadiosityRules rules = {};
  /// Asked now and then: may it go on? Iterations count how far they are on the way, by the logarithm of the bound, in
  /// thousandths. Empty: it may.
  MayGoOn may_go_on = {};
};

enum class RadiosityStatus {
  reached,   ///< bound ≤ tolerance · max |B| in every channel
  rounding,  ///< as near as double comes: rounding is most of what is left of the bound
  limit,     ///< most_steps were not enough
  stalled,   ///< steps no longer help: conjugate gradients with form factors that are not reciprocal, a breakdown
  stopped,   ///< it was not to go on
};
[[nodiscard]] const char* words(RadiosityStatus status);

/// Radiosities and how good they are; whatever the status, the bound is proved.
struct RadiosityReport {
  Eigen::MatrixXd radiosity;  ///< B [W/m²], n × channels
  Eigen::MatrixXd incident;   ///< F B, the irradiance [W/m²], n × channels
  Eigen::VectorXd residual;   ///< of each channel max_i |E_i + ρ_i Σ_j F_ij B_j − B_i| [W/m²]
  Eigen::VectorXd bound;  ///< of each channel, proved: max_i |B_i − exact B_i| ≤ bound [W/m²], rounding included
  Eigen::VectorXd backward_error;  ///< of each channel, componentwise, relative (RadiosityJudgement)
  RadiosityStatus status = RadiosityStatus::reached;
  Eigen::Index steps = 0;  ///< of an iteration; of Southwell's n shots each, of Krylov methods one search direction
  Eigen::Index passes =
      0;  ///< products with F, each of all channels, checks and bounds included (Gauss–Seidel: sweeps too)
  bool dark = false;  ///< nothing is emitted in any channel: B = 0 exactly
};

/// The radiosities of all channels, and how far they can be from the exact solution of the system as given.
///
/// Returns   B with its bound. An iteration ends when the bound is within the tolerance, when rounding allows no better, or
///           after most_steps: status says which, and what was reached is returned. Direct solvers do not iterate: reached
///           or rounding
/// Accuracy  max |B − exact B| ≤ bound, proved (NOTES.md §1, §2), whichever the solver. A solver changes the last digits only
/// Order     the same bits on any number of threads; from every compiler too but for lu, gmres and bicgstab, whose sums are
///           Eigen's
/// Errors    refusal(); emissions so large that radiosities or their bounds overflow; ErrorCode::usage: conjugate
///           gradients without areas, a solver that needs rows of an F that has none; ErrorCode::stopped by a direct
///           solver that may not go on
[[nodiscard]] Result<RadiosityReport> solve_radiosity(const RadiosityEquation& equation, const RadiosityGoal& goal);

}  // namespace etendue
