// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// Absolute error of one product that underflows; the relative model of γ does not cover it.
constexpr double kUnderflow = 0x1p-1074;

struct Row {
  double residual;  // as computed
  double error;     // bound on |computed − exact|, up to the relative factor that residual_bound() adds
};

Row residual_of(const RadiositySystem& system, const Eigen::VectorXd& radiosity, Eigen::Index i) {
  const Eigen::Index n = radiosity.size();
  double incident = 0;
  double magnitude = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    const double term = system.form_factors(i, j) * radiosity(j);
    incident += term;
    magnitude += std::abs(term);
  }
  const double rho = system.reflectance(i);
  const double residual = (system.emission(i) - radiosity(i)) + rho * incident;
  const double scale = (std::abs(system.emission(i)) + std::abs(radiosity(i))) + rho * magnitude;
  return {residual, gamma_bound(static_cast<int>(n) + 3) * scale + static_cast<double>(n + 3) * kUnderflow};
}

}  // namespace

double dominance(const RadiositySystem& system, Eigen::Index row) {
  const Eigen::Index n = system.form_factors.cols();
  double sum = 0;
  for (Eigen::Index j = 0; j < n; ++j) sum += system.form_factors(row, j);
  const double reflected = system.reflectance(row) * sum * (1 + gamma_bound(static_cast<int>(n) + 3));
  return 1 - reflected - kUnitRoundoff;
}

ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity) {
  require(radiosity.size() == system.emission.size(), "residual_bound: one radiosity a patch");
  const double widen = 1 + 2 * gamma_bound(static_cast<int>(radiosity.size()) + 6);
  ResidualBound result;
  for (Eigen::Index i = 0; i < radiosity.size(); ++i) {
    const double margin = dominance(system, i);
    require(margin > 0, "residual_bound: every row is diagonally dominant");
    const Row row = residual_of(system, radiosity, i);
    const double error = (std::abs(row.residual) + row.error * widen) / margin * widen;
    require(std::isfinite(error), "residual_bound: the radiosities are finite");
    result.residual = std::max(result.residual, std::abs(row.residual));
    result.bound = std::max(result.bound, error);
  }
  return result;
}

}  // namespace etendue
