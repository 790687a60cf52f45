// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/factor_repair.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// Uncertainty of a factor beside what reciprocity shows, relative. Only its being the same for all pairs matters.
constexpr double kShare = 0x1p-10;

}  // namespace

Result<RepairedFactors> repaired(const RowMatrix& factors, const Eigen::VectorXd& areas) {
  const Eigen::Index n = areas.size();
  require(factors.rows() == n && factors.cols() == n, "repaired: one area a row of a square matrix");
  ExchangeMatrix exchanges(std::vector<double>(areas.data(), areas.data() + n));
  RepairedFactors result;
  double defect = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = 0;
    for (Eigen::Index j = 0; j < n; ++j) sum += factors(i, j);
    if (sum != 0) defect = std::max(defect, std::abs(1 - sum));
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) {
      const double there = areas(i) * factors(i, j), back = areas(j) * factors(j, i);
      const double mean = 0.5 * there + 0.5 * back, difference = std::abs(there - back);
      result.reciprocity_defect = std::max(result.reciprocity_defect, difference / std::max(areas(i), areas(j)));
      exchanges.set(static_cast<std::size_t>(i), static_cast<std::size_t>(j), {mean, 0.5 * difference + kShare * mean});
    }
  }
  for (std::size_t tile = 0; tile < exchanges.layout().tiles(); ++tile) exchanges.close(tile, {});
  auto closed = repaired(exchanges, row_closure(exchanges));
  if (!closed) {
    return Error{closed.error().code,
                 closed.error().message + " (sums with the mean of A_i F_ij and A_j F_ji in place of both)"};
  }
  result.report = closed->report;
  result.report.defect_before = defect;
  result.factors.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      result.factors(i, j) = closed->matrix.factor(static_cast<std::size_t>(i), static_cast<std::size_t>(j)).value;
    }
  }
  return result;
}

}  // namespace etendue
