// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// δ of a row: Σ_j δ_ij |B_j| and Σ_j δ_ij, plain sums.
struct FactorError {
  double incident = 0;
  double sum = 0;
};

FactorError factor_error_of(const Eigen::MatrixXd& bounds, const Eigen::VectorXd& radiosity, Eigen::Index i) {
  FactorError error;
  for (Eigen::Index j = 0; j < radiosity.size(); ++j) {
    error.incident += bounds(i, j) * std::abs(radiosity(j));
    error.sum += bounds(i, j);
  }
  return error;
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

ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity,
                             const Eigen::MatrixXd& factor_bounds) {
  const Eigen::Index n = radiosity.size();
  require(n == system.emission.size() && factor_bounds.rows() == n && factor_bounds.cols() == n,
          "residual_bound: one radiosity a patch, one bound a form factor");
  const double widen = 1 + 2 * gamma_bound(static_cast<int>(n) + 6);
  ResidualBound result;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row row = residual_of(system, radiosity, i);
    const FactorError factors = factor_error_of(factor_bounds, radiosity, i);
    const double rho = system.reflectance(i);
    const double margin = dominance(system, i) - rho * factors.sum * widen - kUnitRoundoff;
    const double wrong = std::abs(row.residual) + row.error * widen + rho * factors.incident * widen;
    const double error = margin > 0 ? wrong / margin * widen : std::numeric_limits<double>::infinity();
    require(!std::isnan(error), "residual_bound: radiosities and bounds are finite");
    result.residual = std::max(result.residual, std::abs(row.residual));
    result.bound = std::max(result.bound, error);
  }
  return result;
}

}  // namespace etendue
