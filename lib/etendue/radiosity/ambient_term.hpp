// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/floating_point.hpp"

// What progressive radiosity adds for display while light is still unshot. Contract of all functions: vectors have one
// entry a patch, at least one; areas are positive, reflectances in [0, 1].
namespace etendue {

/// F_est of each patch: the share of the light, from wherever, that meets it if only its size counts.
///
///     F_est,i = A_i / Σ_k A_k                                                                     @eq IU.6-14
///
/// Accuracy  relative error ≤ γ_n, proved
[[nodiscard]] Eigen::VectorXd estimated_form_factors(const Eigen::VectorXd& areas);

/// Mean reflectance, weighted by area:  Σ_j ρ_j A_j / Σ_j A_j                                      @eq IU.6-14
///
/// Accuracy  relative error ≤ γ_(2n+1), proved: all terms have one sign
[[nodiscard]] double mean_reflectance(const Eigen::VectorXd& reflectance, const Eigen::VectorXd& areas);

/// All interreflections together: 1 + ρ + ρ² + … = 1/(1 − ρ)                                  @eq IU.6-15, E25
///
/// Domain    0 ≤ ρ < 1: at one the series grows without bound
/// Errors    ContractViolation outside
[[nodiscard]] double interreflection(double mean_reflectance);

/// The ambient radiosity: what the unshot light would bring to any patch if the scene were uniform.
///
///     B_amb = 1/(1 − ρ_mean) Σ_i ΔB_i F_est,i                                                     @eq IU.6-15
///
/// Symbols   ΔB_i unshot radiosity [W/m²]
/// Returns   [W/m²]; 0 once everything is shot
/// Accuracy  exact but for rounding in a sphere of any patches, where F_ij = A_j/ΣA: there B + ρ B_amb is the solution
///           at every step; elsewhere an estimate for display that no later step uses
[[nodiscard]] double ambient_radiosity(const Eigen::VectorXd& unshot, const Eigen::VectorXd& reflectance,
                                       const Eigen::VectorXd& areas);

/// What to show: B_k + ρ_k B_amb.                                                                  @eq IU.6-15
[[nodiscard]] Eigen::VectorXd with_ambient_term(const Eigen::VectorXd& radiosity, const Eigen::VectorXd& reflectance,
                                                double ambient);

}  // namespace etendue
