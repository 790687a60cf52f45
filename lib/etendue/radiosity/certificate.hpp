// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/radiosity/equation.hpp"
#include "etendue/radiosity/system.hpp"

namespace etendue {

/// What one product with F tells about any B, one number a channel where nothing else is said.
struct RadiosityJudgement {
  Eigen::MatrixXd incident;   ///< F B as computed, n × channels [W/m²]
  Eigen::MatrixXd residuals;  ///< r = E + diag(ρ) F B − B as computed, n × channels [W/m²]
  Eigen::VectorXd residual;   ///< max_i |r_i| [W/m²]
  Eigen::VectorXd bound;      ///< proved: max_i |B_i − exact B_i| ≤ bound [W/m²]
  Eigen::VectorXd rounding;   ///< what would be left of the bound if r were zero: no B is known better [W/m²]
  Eigen::VectorXd
      backward_error;  ///< proved: B solves the equation exactly once 1, ρ_i F_ij and E_i are changed by so much
};

/// How far any B, however it was found, can be from the solution of B = E + diag(ρ) F B.           @eq IU.6-7
///
///     ‖B − exact B‖∞ ≤ max_i |r_i| / (1 − ρ_i Σ_j F_ij),   r = E + diag(ρ) F B − B
///
/// Contract  F_ij ≥ 0 (taken at its word) and ρ_i ≥ 0, E finite; the equation outlives the judge
/// Accuracy  proved, the rounding of r, of the denominator and of the quotient enclosed: NOTES.md §1 and §2
class RadiosityJudge {
 public:
  RadiosityJudge(const RadiosityEquation& equation, Eigen::VectorXd row_sums);

  /// One pass over F where B ≥ 0, two where some of it is below. Infinite bounds where magnitudes overflow, or where
  /// margin() is not positive for every row. Contract: sizes fit, B finite
  [[nodiscard]] RadiosityJudgement judge(const Eigen::MatrixXd& radiosity) const;

  /// The bound where each F_ij is known to within errors_ij only: how far B can be from the solution with the exact F.
  ///
  ///     ‖B − exact B‖∞ ≤ max_i ( |r_i| + ρ_i Σ_j δ_ij |B_j| ) / (1 − ρ_i Σ_j (F_ij + δ_ij))
  ///
  /// Contract  δ_ij ≥ 0 (infinite: nothing is known of F_ij); `judgement` is that of `radiosity`
  /// Returns   a bound a channel; infinity where a row with F + δ cannot be shown to be dominant, or overflows
  /// Accuracy  proved as far as δ is: NOTES.md §3
  [[nodiscard]] Eigen::VectorXd bound_with(const FormFactors& errors, const Eigen::MatrixXd& radiosity,
                                           const RadiosityJudgement& judgement) const;

  /// d_i rounded down, of channel c.
  double margin(Eigen::Index i, Eigen::Index c) const { return margins_(i, c); }

 private:
  double residual_error(Eigen::Index i, Eigen::Index c, double magnitude, double radiosity) const;

  const RadiosityEquation& equation_;
  Eigen::VectorXd row_sums_;
  Eigen::MatrixXd margins_;
};

/// The same for one channel, one matrix and one row: d_i, rounded down.                             @eq IU.6-9
[[nodiscard]] double dominance(const RadiositySystem& system, Eigen::Index row);

struct ResidualBound {
  double residual = 0;  ///< max_i |r_i|, as computed [W/m²]
  double bound = 0;     ///< max_j |B_j − exact B_j| ≤ bound [W/m²]
};

/// RadiosityJudge for one channel. Contract: that of the judge, and F_ij ≥ 0, dominance() > 0; all are checked              @eq IU.6-7
[[nodiscard]] ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity);

/// The same where each F_ij is known to within factor_bounds(i, j) only. Contract: dominance is not asked then
[[nodiscard]] ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity,
                                           const Eigen::MatrixXd& factor_bounds);

}  // namespace etendue
