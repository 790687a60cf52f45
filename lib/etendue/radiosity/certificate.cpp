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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

/// NaN fails, infinity passes: it would make the row not dominant.
bool no_entry_below_zero(const Eigen::MatrixXd& matrix) {
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      if (!(matrix(i, j) >= 0)) return false;
    }
  }
  return true;
}

void check_contract(const RadiositySystem& system, const Eigen::VectorXd& radiosity) {
  const Eigen::Index n = radiosity.size();
  require(system.emission.size() == n && system.reflectance.size() == n && system.form_factors.rows() == n &&
              system.form_factors.cols() == n,
          "residual_bound: one radiosity a patch");
  require(no_entry_below_zero(system.form_factors), "residual_bound: form factors are not negative");
  for (Eigen::Index i = 0; i < n; ++i) {
    require(system.reflectance(i) >= 0, "residual_bound: reflectances are not negative");
    require(std::isfinite(radiosity(i)) && std::isfinite(system.emission(i)),
            "residual_bound: radiosities and emissions are finite");
  }
}

/// Enters a row. What overflowed, be it to infinity or, by infinity minus infinity, to NaN, shows nothing.
void enclose(ResidualBound& result, const Row& row, double error) {
  const double residual = std::abs(row.residual);
  result.residual = std::max(result.residual, std::isfinite(residual) ? residual : kInfinity);
  result.bound = std::max(result.bound, std::isfinite(error) ? error : kInfinity);
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
  check_contract(system, radiosity);
  const double widen = 1 + 2 * gamma_bound(static_cast<int>(radiosity.size()) + 6);
  ResidualBound result;
  for (Eigen::Index i = 0; i < radiosity.size(); ++i) {
    const double margin = dominance(system, i);
    require(margin > 0, "residual_bound: every row is diagonally dominant");
    const Row row = residual_of(system, radiosity, i);
    enclose(result, row, (std::abs(row.residual) + row.error * widen) / margin * widen);
  }
  return result;
}

ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity,
                             const Eigen::MatrixXd& factor_bounds) {
  check_contract(system, radiosity);
  const Eigen::Index n = radiosity.size();
  require(factor_bounds.rows() == n && factor_bounds.cols() == n, "residual_bound: one bound a form factor");
  require(no_entry_below_zero(factor_bounds), "residual_bound: bounds are not negative");
  const double widen = 1 + 2 * gamma_bound(static_cast<int>(n) + 6);
  ResidualBound result;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row row = residual_of(system, radiosity, i);
    const FactorError factors = factor_error_of(factor_bounds, radiosity, i);
    const double rho = system.reflectance(i);
    const double margin = dominance(system, i) - rho * factors.sum * widen - kUnitRoundoff;
    const double wrong = std::abs(row.residual) + row.error * widen + rho * factors.incident * widen;
    enclose(result, row, margin > 0 ? wrong / margin * widen : kInfinity);
  }
  return result;
}

}  // namespace etendue
