// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <optional>
#include <utility>

#include "etendue/core/floating_point.hpp"

// F of B = E + diag(ρ) F B as the solvers see it: something that multiplies. How it is stored is its own affair.
namespace etendue {

/// Calls body(k) once for each k in [0, count), in any order, several at a time if it likes; empty: one after the other.
/// This is how a caller with threads lends them: results have the same bits whatever it does.
using Schedule = std::function<void(Eigen::Index count, const std::function<void(Eigen::Index)>& body)>;

/// An entry F(row, column).
struct FormFactorEntry {
  Eigen::Index row = 0, column = 0;
  double value = 0;
};

/// The form factors F_ij ≥ 0 of n patches, row = from, column = to.                                @eq IU.6-7
class FormFactors {
 public:
  explicit FormFactors(Schedule schedule = {}) : schedule_(std::move(schedule)) {}
  virtual ~FormFactors() = default;

  virtual Eigen::Index size() const = 0;

  /// Roundings that a term F_ij x_j passes at most on its way into Σ_j F_ij x_j, so that |computed − exact| ≤ γ_k Σ_j F_ij |x_j|
  /// short of underflow. The error bounds of every solution rest on this number.
  virtual int roundings() const = 0;

  /// F x: one pass over F multiplies all columns of x, the channels.
  virtual Eigen::MatrixXd times(const Eigen::MatrixXd& x) const;

  /// Can rows be had one at a time? What only multiplies as a whole says no.
  virtual bool by_rows() const { return true; }
  /// Rows first … first + count − 1 of F x, the same bits as in times(). Contract: by_rows()
  virtual Eigen::MatrixXd rows_times(const Eigen::MatrixXd& x, Eigen::Index first, Eigen::Index count) const = 0;
  /// F_ij for one j. Contract: by_rows()
  virtual Eigen::VectorXd column(Eigen::Index j) const = 0;
  /// F as a dense matrix.
  virtual Eigen::MatrixXd dense() const;

  /// The first entry, row by row, that is not in [0, most]; an operator that cannot look at its entries says none.
  virtual std::optional<FormFactorEntry> entry_outside(double most) const = 0;

 protected:
  FormFactors(const FormFactors&) = default;
  FormFactors& operator=(const FormFactors&) = default;
  /// body(first, count) for blocks of rows that together are all rows, as scheduled.
  void each_block(const std::function<void(Eigen::Index first, Eigen::Index count)>& body) const;

 private:
  Schedule schedule_;
};

/// Rows one after the other in memory: a product reads F once, from its first to its last number.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// All n² numbers.
///
/// Accuracy  roundings() = ⌈n/4⌉ + 3: four partial sums a row (NOTES.md §2)
/// Order     every product and sum has its place: the same bits from every compiler, on any number of threads
class DenseFactors : public FormFactors {
 public:
  /// Contract: square
  explicit DenseFactors(RowMatrix factors, Schedule schedule = {});
  /// The same matrix, stored by columns: copied.
  explicit DenseFactors(const Eigen::MatrixXd& factors, Schedule schedule = {});

  Eigen::Index size() const override { return factors_.rows(); }
  int roundings() const override { return static_cast<int>((size() + 3) / 4) + 3; }
  Eigen::MatrixXd rows_times(const Eigen::MatrixXd& x, Eigen::Index first, Eigen::Index count) const override;
  Eigen::VectorXd column(Eigen::Index j) const override { return factors_.col(j); }
  Eigen::MatrixXd dense() const override { return factors_; }
  std::optional<FormFactorEntry> entry_outside(double most) const override;
  const RowMatrix& matrix() const { return factors_; }

 private:
  RowMatrix factors_;
};

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Only the entries that are not zero, twice: by rows and by columns.
///
/// Accuracy  roundings() = 1 + the entries of the fullest row
class SparseFactors : public FormFactors {
 public:
  /// Contract: square
  explicit SparseFactors(SparseRows factors, Schedule schedule = {});

  Eigen::Index size() const override { return factors_.rows(); }
  int roundings() const override { return roundings_; }
  Eigen::MatrixXd rows_times(const Eigen::MatrixXd& x, Eigen::Index first, Eigen::Index count) const override;
  Eigen::VectorXd column(Eigen::Index j) const override { return columns_.col(j); }
  Eigen::MatrixXd dense() const override { return factors_; }
  std::optional<FormFactorEntry> entry_outside(double most) const override;
  const SparseRows& matrix() const { return factors_; }

 private:
  SparseRows factors_;
  Eigen::SparseMatrix<double> columns_;
  int roundings_ = 0;
};

/// A function that multiplies: hierarchical factors, factors that are computed on the way, another library's.
///
/// Contract  F_ij ≥ 0; `times` is linear, has at most `roundings` roundings a term and gives n rows
class OperatorFactors : public FormFactors {
 public:
  using Times = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& x)>;
  OperatorFactors(Eigen::Index size, int roundings, Times times);

  Eigen::Index size() const override { return size_; }
  int roundings() const override { return roundings_; }
  Eigen::MatrixXd times(const Eigen::MatrixXd& x) const override;
  bool by_rows() const override { return false; }
  Eigen::MatrixXd rows_times(const Eigen::MatrixXd& x, Eigen::Index first, Eigen::Index count) const override;
  Eigen::VectorXd column(Eigen::Index j) const override;
  std::optional<FormFactorEntry> entry_outside(double) const override { return std::nullopt; }

 private:
  Eigen::Index size_;
  int roundings_;
  Times times_;
};

}  // namespace etendue
