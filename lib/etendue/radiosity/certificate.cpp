// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// Absolute error of one product that underflows; the relative model of γ does not cover it.
constexpr double kUnderflow = 0x1p-1074;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Covers the roundings that follow those of the residual (NOTES.md §2).
double widening(int roundings) {
  return 1 + 2 * gamma_bound(roundings + 6);
}

/// What overflowed, be it to infinity or, by infinity minus infinity, to NaN, shows nothing.
void raise(double& most, double value) {
  most = std::max(most, std::isfinite(value) ? value : kInfinity);
}

void check(const RadiosityEquation& equation, const Eigen::VectorXd& row_sums) {
  const auto error = misfit(equation);
  require(!error && row_sums.size() == equation.emission.rows(), "RadiosityJudge: the sizes fit");
  for (Eigen::Index c = 0; c < equation.emission.cols(); ++c) {
    for (Eigen::Index i = 0; i < equation.emission.rows(); ++i) {
      require(equation.reflectance(i, c) >= 0, "RadiosityJudge: reflectances are not negative");
      require(std::isfinite(equation.emission(i, c)), "RadiosityJudge: emissions are finite");
    }
  }
}

bool somewhere_below_zero(const Eigen::MatrixXd& values) {
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      if (values(i, c) < 0) return true;
    }
  }
  return false;
}

RadiosityEquation one_channel(const RadiositySystem& system) {
  return {std::make_shared<DenseFactors>(system.form_factors), system.reflectance, system.emission, {}, {}};
}

void check(const RadiositySystem& system, const Eigen::VectorXd& radiosity) {
  const Eigen::Index n = radiosity.size();
  require(n > 0 && system.emission.size() == n && system.reflectance.size() == n && system.form_factors.rows() == n &&
              system.form_factors.cols() == n,
          "residual_bound: one radiosity a patch");
}

}  // namespace

RadiosityJudge::RadiosityJudge(const RadiosityEquation& equation, Eigen::VectorXd row_sums)
    : equation_(equation), row_sums_(std::move(row_sums)) {
  check(equation_, row_sums_);
  margins_.resize(equation_.emission.rows(), equation_.emission.cols());
  const int roundings = equation_.factors->roundings();
  for (Eigen::Index c = 0; c < margins_.cols(); ++c) {
    for (Eigen::Index i = 0; i < margins_.rows(); ++i) {
      margins_(i, c) = dominance(equation_.reflectance(i, c), row_sums_(i), roundings);
    }
  }
}

/// Bound on |computed − exact| of r_i, up to the widening. @param magnitude fl(Σ_j F_ij |B_j|)
double RadiosityJudge::residual_error(Eigen::Index i, Eigen::Index c, double magnitude, double radiosity) const {
  const double scale =
      (std::abs(equation_.emission(i, c)) + std::abs(radiosity)) + equation_.reflectance(i, c) * magnitude;
  const auto products = static_cast<double>(equation_.factors->size() + 3);
  return gamma_bound(equation_.factors->roundings() + 3) * scale + products * kUnderflow;
}

RadiosityJudgement RadiosityJudge::judge(const Eigen::MatrixXd& radiosity) const {
  const Eigen::Index n = equation_.emission.rows(), channels = equation_.emission.cols();
  require(radiosity.rows() == n && radiosity.cols() == channels, "RadiosityJudge: one radiosity a patch and channel");
  const double widen = widening(equation_.factors->roundings());
  RadiosityJudgement result;
  result.incident = equation_.factors->times(radiosity);
  const bool mixed = somewhere_below_zero(radiosity);
  const Eigen::MatrixXd absolute = mixed ? equation_.factors->times(radiosity.cwiseAbs()) : Eigen::MatrixXd();
  const Eigen::MatrixXd& magnitudes = mixed ? absolute : result.incident;
  result.residuals.resize(n, channels);
  result.residual = result.bound = result.rounding = result.backward_error = Eigen::VectorXd::Zero(channels);
  for (Eigen::Index c = 0; c < channels; ++c) {
    bool dark = true;  // B = 0: no product, nothing is rounded
    for (Eigen::Index i = 0; i < n && dark; ++i) dark = radiosity(i, c) == 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double b = radiosity(i, c), e = equation_.emission(i, c), rho = equation_.reflectance(i, c);
      require(std::isfinite(b), "RadiosityJudge: radiosities are finite");
      const double residual = (e - b) + rho * result.incident(i, c);
      const double error = dark ? 0 : residual_error(i, c, magnitudes(i, c), b) * widen;
      const double wrong = std::abs(residual) + error;
      result.residuals(i, c) = residual;
      raise(result.residual(c), std::abs(residual));
      const double margin = margins_(i, c);
      raise(result.bound(c), margin > 0 ? wrong / margin * widen : kInfinity);
      raise(result.rounding(c), margin > 0 ? error / margin * widen : kInfinity);
      const double scale = (std::abs(e) + std::abs(b)) + rho * magnitudes(i, c);
      if (scale > 0) raise(result.backward_error(c), wrong / scale * widen);
    }
  }
  return result;
}

Eigen::VectorXd RadiosityJudge::bound_with(const FormFactors& errors, const Eigen::MatrixXd& radiosity,
                                           const RadiosityJudgement& judgement) const {
  const Eigen::Index n = equation_.emission.rows(), channels = equation_.emission.cols();
  require(errors.size() == n && radiosity.rows() == n && radiosity.cols() == channels &&
              judgement.residuals.rows() == n && judgement.residuals.cols() == channels,
          "RadiosityJudge: one bound a form factor");
  const int roundings = equation_.factors->roundings();
  const double widen = widening(std::max(roundings, errors.roundings()));
  Eigen::MatrixXd magnitudes(n, channels + 1);
  magnitudes << radiosity.cwiseAbs(), Eigen::VectorXd::Ones(n);
  const Eigen::MatrixXd wrong_factors = errors.times(magnitudes);
  const Eigen::MatrixXd incident =
      somewhere_below_zero(radiosity) ? equation_.factors->times(radiosity.cwiseAbs()) : judgement.incident;
  Eigen::VectorXd bound = Eigen::VectorXd::Zero(channels);
  for (Eigen::Index c = 0; c < channels; ++c) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double rho = equation_.reflectance(i, c);
      const double margin = margins_(i, c) - rho * wrong_factors(i, channels) * widen - kUnitRoundoff;
      const double wrong = std::abs(judgement.residuals(i, c)) +
                           residual_error(i, c, incident(i, c), radiosity(i, c)) * widen +
                           rho * wrong_factors(i, c) * widen;
      raise(bound(c), margin > 0 ? wrong / margin * widen : kInfinity);
    }
  }
  return bound;
}

double dominance(const RadiositySystem& system, Eigen::Index row) {
  double sum = 0;
  for (Eigen::Index j = 0; j < system.form_factors.cols(); ++j) sum += system.form_factors(row, j);
  return dominance(system.reflectance(row), sum, static_cast<int>(system.form_factors.cols()));
}

ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity) {
  check(system, radiosity);
  const RadiosityEquation equation = one_channel(system);
  require(!equation.factors->entry_outside(std::numeric_limits<double>::max()),
          "residual_bound: form factors are not negative, and finite");
  const RadiosityJudge judge(equation, row_sums(*equation.factors));
  for (Eigen::Index i = 0; i < radiosity.size(); ++i) {
    require(judge.margin(i, 0) > 0, "residual_bound: every row is diagonally dominant");
  }
  const RadiosityJudgement found = judge.judge(radiosity);
  return {found.residual(0), found.bound(0)};
}

ResidualBound residual_bound(const RadiositySystem& system, const Eigen::VectorXd& radiosity,
                             const Eigen::MatrixXd& factor_bounds) {
  check(system, radiosity);
  require(factor_bounds.rows() == radiosity.size() && factor_bounds.cols() == radiosity.size(),
          "residual_bound: one bound a form factor");
  const DenseFactors errors(factor_bounds);
  require(!errors.entry_outside(kInfinity), "residual_bound: bounds are not negative");
  const RadiosityEquation equation = one_channel(system);
  require(!equation.factors->entry_outside(std::numeric_limits<double>::max()),
          "residual_bound: form factors are not negative, and finite");
  const RadiosityJudge judge(equation, row_sums(*equation.factors));
  const RadiosityJudgement found = judge.judge(radiosity);
  return {found.residual(0), judge.bound_with(errors, radiosity, found)(0)};
}

}  // namespace etendue
