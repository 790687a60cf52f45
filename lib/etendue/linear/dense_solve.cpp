// SPDX-License-Identifier: Apache-2.0
#include "etendue/linear/dense_solve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

Error invalid(const std::string& message) {
  return {ErrorCode::invalid_input, message};
}

std::optional<Error> unfit(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rhs) {
  if (matrix.rows() != matrix.cols() || matrix.rows() != rhs.rows()) {
    return invalid("matrix is " + std::to_string(matrix.rows()) + " × " + std::to_string(matrix.cols()) +
                   " and the right-hand side has " + std::to_string(rhs.rows()) + " entries: no square system");
  }
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (!std::isfinite(rhs(i))) return invalid("right-hand side entry " + std::to_string(i) + " is not finite");
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      if (!std::isfinite(matrix(i, j))) {
        return invalid("matrix entry (" + std::to_string(i) + ", " + std::to_string(j) + ") is not finite");
      }
    }
  }
  return std::nullopt;
}

constexpr BackwardError kNothingShown{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

Result<LinearSolution> judged(const Eigen::MatrixXd& matrix, Eigen::VectorXd x, const Eigen::VectorXd& rhs) {
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    if (!std::isfinite(x(i))) return invalid("unknown " + std::to_string(i) + " overflows: matrix is near singular");
  }
  const BackwardError error = backward_error(matrix, x, rhs);
  return LinearSolution{std::move(x), error};
}

}  // namespace

bool all_finite(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      if (!std::isfinite(values(i, j))) return false;
    }
  }
  return true;
}

BackwardError backward_error(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& x, const Eigen::VectorXd& rhs) {
  require(matrix.rows() == rhs.rows() && matrix.cols() == x.rows(), "backward_error: the sizes fit");
  require(all_finite(matrix) && all_finite(x) && all_finite(rhs), "backward_error: entries are finite");
  const double gamma = gamma_bound(static_cast<int>(matrix.cols()) + 2);
  double worst_componentwise = 0;
  double worst_residual = 0;
  double matrix_norm = 0;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    double residual = rhs(i);
    double scale = std::abs(rhs(i));
    double row_sum = 0;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const double term = matrix(i, j) * x(j);
      residual -= term;
      scale += std::abs(term);
      row_sum += std::abs(matrix(i, j));
    }
    // Products that overflow may cancel to NaN in the residual, which max would pass over.
    if (!std::isfinite(scale) || !std::isfinite(residual)) return kNothingShown;
    matrix_norm = std::max(matrix_norm, row_sum);
    worst_residual = std::max(worst_residual, std::abs(residual) + gamma * scale);
    if (scale > 0) worst_componentwise = std::max(worst_componentwise, std::abs(residual) / scale + gamma);
  }
  const double norm =
      matrix_norm * (x.size() ? x.lpNorm<Eigen::Infinity>() : 0) + (rhs.size() ? rhs.lpNorm<Eigen::Infinity>() : 0);
  if (!std::isfinite(norm)) return kNothingShown;
  // 1 + 4 γ: the sums in both denominators and the divisions themselves (NOTES.md §2).
  return {norm > 0 ? worst_residual / norm * (1 + 4 * gamma) : 0, worst_componentwise * (1 + 4 * gamma)};
}

Result<LinearSolution> solve_gaussian(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rhs) {
  return stoppable_gaussian(matrix, rhs, {});
}

Result<LinearSolution> stoppable_gaussian(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rhs,
                                          const MayGoOn& may_go_on) {
  if (const auto error = unfit(matrix, rhs)) return *error;
  auto x = gaussian_elimination<double>(matrix, rhs, may_go_on);
  if (!x) return x.error();
  return judged(matrix, std::move(x).value(), rhs);
}

Result<LinearSolution> solve_eigen_lu(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rhs) {
  if (const auto error = unfit(matrix, rhs)) return *error;
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(matrix);
  const auto& factors = lu.matrixLU();
  for (Eigen::Index k = 0; k < factors.rows(); ++k) {
    if (factors(k, k) == 0) {
      return invalid("matrix is singular: column " + std::to_string(k) +
                     " depends on the columns before it, no pivot is left");
    }
  }
  return judged(matrix, lu.solve(rhs), rhs);
}

}  // namespace etendue
