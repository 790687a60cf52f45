// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/balance.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

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

PowerBalance power_balance(const RadiosityEquation& equation, const RadiosityReport& solution, Eigen::Index channel) {
  const Eigen::Index n = equation.emission.rows();
  require(equation.areas.size() == n && solution.radiosity.rows() == n && solution.incident.rows() == n,
          "power_balance: one area and one radiosity a patch");
  require(channel >= 0 && channel < equation.emission.cols() && channel < solution.radiosity.cols(),
          "power_balance: the channel exists");
  const Eigen::VectorXd sums = row_sums(*equation.factors);
  PowerBalance balance;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double area = equation.areas(i);
    balance.emitted += area * equation.emission(i, channel);
    balance.absorbed += area * (1 - equation.reflectance(i, channel)) * solution.incident(i, channel);
    balance.escaped += area * solution.radiosity(i, channel) * (1 - sums(i));
  }
  balance.defect = balance.emitted - balance.absorbed - balance.escaped;
  return balance;
}

PowerBalance power_balance(const RadiositySystem& system, const Eigen::VectorXd& areas,
                           const Eigen::VectorXd& radiosity) {
  const Eigen::Index n = system.form_factors.rows();
  require(areas.size() == n && radiosity.size() == n, "power_balance: one area and one radiosity a patch");
  const RadiosityEquation equation{
      std::make_shared<DenseFactors>(system.form_factors), system.reflectance, system.emission, areas, {}};
  RadiosityReport solution;
  solution.radiosity = radiosity;
  solution.incident = equation.factors->times(radiosity);
  return power_balance(equation, solution, 0);
}

}  // namespace etendue
