// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/balance.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

// Plain loops in a stated order: the same bits from every compiler, which Eigen's vectorised reductions do not promise.
double weighted_row_sum(const Eigen::MatrixXd& matrix, Eigen::Index row, const Eigen::VectorXd& weights) {
  double sum = 0;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) sum += matrix(row, j) * weights(j);
  return sum;
}

}  // namespace

Eigen::VectorXd closure_defects(const Eigen::MatrixXd& form_factors) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(form_factors.cols());
  Eigen::VectorXd defects(form_factors.rows());
  for (Eigen::Index i = 0; i < form_factors.rows(); ++i) defects(i) = 1 - weighted_row_sum(form_factors, i, ones);
  return defects;
}

double reciprocity_defect(const Eigen::MatrixXd& form_factors, const Eigen::VectorXd& areas) {
  require(form_factors.rows() == form_factors.cols() && areas.size() == form_factors.rows(),
          "reciprocity_defect: one area a row of a square matrix");
  double worst = 0;
  for (Eigen::Index i = 0; i < form_factors.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      worst = std::max(worst, std::abs(areas(i) * form_factors(i, j) - areas(j) * form_factors(j, i)));
    }
  }
  return worst;
}

PowerBalance power_balance(const RadiositySystem& system, const Eigen::VectorXd& areas,
                           const Eigen::VectorXd& radiosity) {
  const Eigen::Index n = system.form_factors.rows();
  require(areas.size() == n && radiosity.size() == n, "power_balance: one area and one radiosity a patch");
  const Eigen::VectorXd closure = closure_defects(system.form_factors);
  PowerBalance balance;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double incident = weighted_row_sum(system.form_factors, i, radiosity);
    balance.emitted += areas(i) * system.emission(i);
    balance.absorbed += areas(i) * (1 - system.reflectance(i)) * incident;
    balance.escaped += areas(i) * radiosity(i) * closure(i);
  }
  balance.defect = balance.emitted - balance.absorbed - balance.escaped;
  return balance;
}

}  // namespace etendue
