// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/result.hpp"
#include "etendue/radiosity/system.hpp"

// Progressive refinement: patches shoot their unshot light, one after the other. A step needs the form factors of one
// patch only.                                                                                       @eq IU.6.6
// Contract of all functions: areas are positive.
namespace etendue {

/// The radiosities found so far, and the part of them that no other patch has seen yet.
struct ShootingState {
  Eigen::MatrixXd radiosity;  ///< B [W/m²], n × channels, from below: never above the solution but for rounding
  Eigen::MatrixXd unshot;     ///< ΔB [W/m²], n × channels
};

/// Before the first step everything that is emitted is unshot: B = ΔB = E, n × channels.
[[nodiscard]] ShootingState before_shooting(const Eigen::MatrixXd& emission);

/// The patch with the largest unshot power |ΔB_j| A_j, all channels together; the first of equals.    @eq IU.6-13
[[nodiscard]] Eigen::Index brightest_unshot(const ShootingState& state, const Eigen::VectorXd& areas);

/// One step: patch j shoots what it has not shot.
///
///     ΔB_i = ρ_i ΔB_j F_ji A_j/A_i     added to B_i and to what i has not shot              @eq IU.6-12, IU.6-13
///
/// Symbols   F_ji form factors from j, one a patch; ρ reflectances, n × channels; A areas [m²]
/// Domain    a concave patch may see itself (F_jj > 0): what it gives itself stays unshot
/// Accuracy  componentwise relative error of one increment ≤ γ_4, proved: four operations
/// Errors    ContractViolation where sizes or the index do not fit, or an area is not positive
[[nodiscard]] ShootingState shoot(ShootingState state, Eigen::Index j, const Eigen::VectorXd& factors_from_j,
                                  const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& areas);

/// The same step from the factors *to* j, which need no areas: ΔB_i = ρ_i F_ij ΔB_j. So shooting is Southwell's relaxation:
/// unshot light is the residual of what was shot.                                             @eq IU.6-12, IU.6-13
[[nodiscard]] ShootingState shoot_along(ShootingState state, Eigen::Index j, const Eigen::VectorXd& factors_to_j,
                                        const Eigen::MatrixXd& reflectance);

/// Σ ΔB_j A_j / Σ E_j A_j over all channels: the share of the emitted power that is still to be shot.                 @eq IU.6.6, E26
[[nodiscard]] double unshot_share(const ShootingState& state, const Eigen::MatrixXd& emission,
                                  const Eigen::VectorXd& areas);

/// How far the state is below the solution at most, rounding apart: B* − B = (I − ρF)⁻¹ ρF ΔB, so every entry lies in
/// [0, ρ_max/(1 − ρ_max) max ΔB] where ρ_max is the largest reflectance of the channel and rows of F sum to at most one.
///
/// Errors    ContractViolation where ρ_max is not below one
[[nodiscard]] double shooting_gap(const ShootingState& state, const Eigen::MatrixXd& reflectance);

/// When to stop, and when to give up.
struct ShootingGoal {
  double unshot_share = 1e-3;  ///< the source text's 0.1 % of the emitted power
  int most_steps = 1'000'000;
};

/// Where a run of steps ended. `reached` says whether the goal was met.
struct ShootingReport {
  ShootingState state;
  int steps = 0;
  double unshot_share = 0;
  double gap = 0;  ///< shooting_gap() of the state
  bool reached = false;
};

/// Shoots from the brightest patch until the goal is met or the steps are used up.          @eq IU.6.6, IU.6-13
///
/// Domain    what solve_radiosity() accepts, with reciprocal form factors, some emission, and reflectances below one
/// Errors    ContractViolation where sizes do not fit or nothing is emitted
[[nodiscard]] ShootingReport shoot_until(const RadiositySystem& system, const Eigen::VectorXd& areas,
                                         const ShootingGoal& goal = {});

}  // namespace etendue
