// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/result.hpp"
#include "etendue/linear/gaussian_elimination.hpp"

namespace etendue {

/// How much A and b must be changed, relatively, for a computed x to solve A x = b exactly; upper bounds, the rounding
/// of the residual enclosed (NOTES.md §2, proved). The enclosure alone contributes up to γ_(n+2).
struct BackwardError {
  double normwise = 0;       ///< max_i |r_i| / (‖A‖∞ ‖x‖∞ + ‖b‖∞)            (Rigal and Gaches 1967)
  double componentwise = 0;  ///< max_i |r_i| / (|A| |x| + |b|)_i               (Oettli and Prager 1964)
};

/// Entry by entry: Eigen's allFinite() is a sum that may overflow.
[[nodiscard]] bool all_finite(const Eigen::Ref<const Eigen::MatrixXd>& values);

/// Returns   infinity where |A| |x| + |b| overflows: nothing is shown then
/// Errors    ContractViolation where sizes do not fit or an entry of A, x or b is not finite
[[nodiscard]] BackwardError backward_error(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& x,
                                           const Eigen::VectorXd& rhs);

/// A computed solution and its backward error.
struct LinearSolution {
  Eigen::VectorXd x;
  BackwardError backward_error;
};

/// A x = b by gaussian_elimination().                                                              @eq IU.6-9
///
/// Domain    square matrix, finite entries
/// Returns   x and its backward error
/// Errors    shapes that do not fit, non-finite entries, a singular matrix (the column is named), overflow
[[nodiscard]] Result<LinearSolution> solve_gaussian(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rhs);

/// The same, to the last bit; ErrorCode::stopped when `may_go_on` says no.
[[nodiscard]] Result<LinearSolution> stoppable_gaussian(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rhs,
                                                        const MayGoOn& may_go_on);

/// The same system by Eigen's blocked LU with partial pivoting: faster; its block size follows the processor's caches,
/// so that the last bits may differ between machines. It cannot be stopped.
[[nodiscard]] Result<LinearSolution> solve_eigen_lu(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rhs);

}  // namespace etendue
