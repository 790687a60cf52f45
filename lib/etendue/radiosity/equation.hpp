// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/radiosity/form_factors.hpp"

namespace etendue {

/// B = E + diag(ρ) F B, one system a colour channel, all with the same form factors.          @eq IU.6-7 … IU.6-9
///
///     B_i = E_i + ρ_i Σ_j F_ij B_j
struct RadiosityEquation {
  std::shared_ptr<const FormFactors> factors;  ///< F, of n patches
  Eigen::MatrixXd reflectance;                 ///< ρ, n × channels, in [0, 1)
  Eigen::MatrixXd emission;                    ///< E [W/m²], n × channels, not negative
  Eigen::VectorXd areas;                       ///< A [m²], n; or none: only conjugate gradients need them
  std::vector<std::string> channels;           ///< what messages call them ("red channel"); or none: numbers from 0
};

/// What is taken for the equation of real patches.
struct RadiosityRules {
  /// How far a given F_ij may be above the exact one, which is a share of power and at most 1: without word of it, what
  /// form factors are computed to by default (Tolerance).
  double factor_error = 1e-12;
  /// How far Σ_j F_ij may be above 1, which it exceeds in no room: without word of it any excess is taken that leaves
  /// ρ_i Σ_j F_ij below 1, for the solution exists then (NOTES.md §5 needs such systems).
  std::optional<double> row_excess;
};

/// Why this is no radiosity equation; nothing where it is one. @param row_sums Σ_j F_ij as computed by a product
///
/// Errors    sizes that do not fit, no patch, no channel, non-finite entries, E < 0 (a patch emits or does not; absorption
///           is ρ), F_ij < 0 or above 1 + factor_error, row sums above 1 + row_excess (the worst rows are named), ρ
///           outside [0, 1) (at ρ = 1 the sum of the interreflections diverges: E25), rows that cannot be shown to keep
///           ρ_i Σ_j F_ij below 1, areas that are not positive. The message names channel, row and value
[[nodiscard]] std::optional<Error> refusal(const RadiosityEquation& equation, const Eigen::VectorXd& row_sums,
                                           const RadiosityRules& rules);

/// Of refusal(), what can be said before anything is multiplied: the sizes.
[[nodiscard]] std::optional<Error> misfit(const RadiosityEquation& equation);

/// Σ_j F_ij for each row: one product with ones.                                                   @eq IU.6-6
[[nodiscard]] Eigen::VectorXd row_sums(const FormFactors& factors);

struct RowSum {
  Eigen::Index row = 0;
  double sum = 0;
};

/// Rows that give out more than they have, Σ_j F_ij > 1 + excess; the worst first.                  @eq IU.6-6
[[nodiscard]] std::vector<RowSum> rows_above_one(const Eigen::VectorXd& row_sums, double excess);

/// "red channel: " or "channel 2: "; nothing where there is but one and it has no name.
[[nodiscard]] std::string channel_prefix(const RadiosityEquation& equation, Eigen::Index channel);

/// 1 − ρ ŝ rounded down, ŝ = fl(Σ_j F_ij) with at most `roundings` a term: by how much a row of I − diag(ρ)F is diagonally
/// dominant.                                                                                        @eq IU.6-9
///
/// Returns   a lower bound on d_i = 1 − ρ_i Σ_j F_ij, below it by at most γ_(2k+12) (1 + ρ_i Σ_j F_ij) (proved, NOTES.md
///           §2); zero or less means that the row cannot be shown to be dominant
[[nodiscard]] double dominance(double reflectance, double row_sum, int roundings);

}  // namespace etendue
