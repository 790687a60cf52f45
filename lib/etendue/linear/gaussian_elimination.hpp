// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <utility>

#include "etendue/core/result.hpp"

namespace etendue {

template <class Scalar>
using DenseMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using DenseVector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Asked before each column of an elimination: may it go on? Never changes a result. Empty: it may.
using MayGoOn = std::function<bool(Eigen::Index done, Eigen::Index total)>;

namespace detail {

template <class Scalar>
Scalar magnitude(const Scalar& x) {
  return x < Scalar(0) ? Scalar(-x) : x;
}

/// Row at or below `column` whose entry in that column is the largest in magnitude: the partial pivot.
template <class Scalar>
Eigen::Index pivot_row(const DenseMatrix<Scalar>& matrix, Eigen::Index column) {
  Eigen::Index best = column;
  for (Eigen::Index row = column + 1; row < matrix.rows(); ++row) {
    if (magnitude<Scalar>(matrix(best, column)) < magnitude<Scalar>(matrix(row, column))) best = row;
  }
  return best;
}

template <class Scalar>
void eliminate_below(DenseMatrix<Scalar>& matrix, DenseVector<Scalar>& rhs, Eigen::Index k) {
  const Eigen::Index n = matrix.rows();
  for (Eigen::Index i = k + 1; i < n; ++i) {
    matrix(i, k) = matrix(i, k) / matrix(k, k);
    rhs(i) -= matrix(i, k) * rhs(k);
  }
  for (Eigen::Index j = k + 1; j < n; ++j) {  // column by column: the storage order
    const Scalar top = matrix(k, j);
    if (top == Scalar(0)) continue;
    for (Eigen::Index i = k + 1; i < n; ++i) matrix(i, j) -= matrix(i, k) * top;
  }
}

template <class Scalar>
void substitute_back(const DenseMatrix<Scalar>& upper, DenseVector<Scalar>& rhs) {
  for (Eigen::Index j = upper.rows() - 1; j >= 0; --j) {
    rhs(j) = rhs(j) / upper(j, j);
    for (Eigen::Index i = 0; i < j; ++i) rhs(i) -= upper(i, j) * rhs(j);
  }
}

}  // namespace detail

/// Solves `matrix` · x = `rhs` by Gaussian elimination with partial pivoting.                      @eq IU.6-9
///
/// Domain    square matrix; Scalar is any ordered field type: double, or an exact rational
/// Returns   x; over an exact field the exact solution
/// Accuracy  in double: solve_gaussian() returns a proved upper bound of the backward error it reached
/// Errors    a column without a pivot other than zero: the matrix is singular (exact field), or singular as computed;
///           ErrorCode::stopped when it may not go on
/// Order     every operation has its place: the same bits from any compiler that keeps IEEE-754
template <class Scalar>
[[nodiscard]] Result<DenseVector<Scalar>> gaussian_elimination(DenseMatrix<Scalar> matrix, DenseVector<Scalar> rhs,
                                                               const MayGoOn& may_go_on = {}) {
  require(matrix.rows() == matrix.cols(), "gaussian_elimination: the matrix is square");
  require(matrix.rows() == rhs.rows(), "gaussian_elimination: the right-hand side has one entry a row");
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) {
    if (may_go_on && !may_go_on(k, matrix.rows())) {
      return Error{ErrorCode::stopped,
                   "elimination stopped before column " + std::to_string(k) + " of " + std::to_string(matrix.rows())};
    }
    const Eigen::Index pivot = detail::pivot_row<Scalar>(matrix, k);
    const Scalar value = matrix(pivot, k);
    if (value == Scalar(0) || value != value) {
      return Error{ErrorCode::invalid_input, "matrix is singular: column " + std::to_string(k) +
                                                 " depends on the columns before it, no pivot is left"};
    }
    if (pivot != k) {
      for (Eigen::Index j = k; j < matrix.cols(); ++j) std::swap(matrix(k, j), matrix(pivot, j));
      std::swap(rhs(k), rhs(pivot));
    }
    detail::eliminate_below<Scalar>(matrix, rhs, k);
  }
  detail::substitute_back<Scalar>(matrix, rhs);
  return rhs;
}

}  // namespace etendue
