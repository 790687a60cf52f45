// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CGAL/Gmpq.h>

#include <memory>
#include <vector>

#include "etendue/radiosity/solve.hpp"
#include "radiosity/exact_system.hpp"
#include "support/counter_random.hpp"

// Equations whose numbers are few bits long, so that rationals stay short, and their exact solutions.
namespace etendue::validation {

inline std::vector<RadiositySolver> all_solvers() {
  std::vector<RadiositySolver> all;
  for (const std::string& name : solver_names()) all.push_back(*solver_named(name));
  return all;
}

inline RadiosityGoal goal(RadiositySolver solver, double tolerance = 1e-10) {
  RadiosityGoal wanted;
  wanted.solver = solver;
  wanted.tolerance = tolerance;
  return wanted;
}

/// A room that leaks: A_i is a power of two, A_i F_ij a whole number, the same from both sides, so F is exact and reciprocal.
/// ρ and E are multiples of 2^-10. Rows sum to 1 or less.
inline RadiosityEquation dyadic_equation(CounterRandom& random, Eigen::Index n, Eigen::Index channels,
                                         double most_reflectance) {
  RadiosityEquation equation{
      nullptr, Eigen::MatrixXd(n, channels), Eigen::MatrixXd(n, channels), Eigen::VectorXd(n), {}};
  RowMatrix factors(n, n);
  double base = 256;
  while (base * 1.75 < 7 * static_cast<double>(n)) base *= 2;
  const double most = base * 1.75 / static_cast<double>(n);  // so that rows sum to 7/8 of the base on the average
  for (Eigen::Index i = 0; i < n; ++i) {
    equation.areas(i) = random.unit() < 0.5 ? base : 2 * base;
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double exchange = i == j ? 0 : std::floor(random.unit() * most);
      factors(i, j) = factors(j, i) = exchange;
    }
    for (Eigen::Index c = 0; c < channels; ++c) {
      const double rho = random.unit(), emission = random.unit();
      equation.reflectance(i, c) = random.unit() < 0.1 ? 0 : std::floor(rho * most_reflectance * 1024) / 1024;
      equation.emission(i, c) = random.unit() < 0.6 ? 0 : std::floor(emission * 1024) / 16;
    }
  }
  equation.emission.row(0).setConstant(50);
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = 0;
    for (Eigen::Index j = 0; j < n; ++j) sum += factors(i, j);
    while (sum > equation.areas(i)) equation.areas(i) *= 2;
  }
  for (Eigen::Index i = 0; i < n; ++i) factors.row(i) /= equation.areas(i);
  equation.factors = std::make_shared<DenseFactors>(factors);
  return equation;
}

/// A sphere of any patches: F_ij = A_j/ΣA, so B_i = E_i + ρ_i H with H = Σ_j A_j E_j / Σ_j A_j (1 − ρ_j). The areas are whole
/// numbers whose sum is a power of two: F is exact.
inline RadiosityEquation sphere_equation(CounterRandom& random, Eigen::Index n, Eigen::Index channels,
                                         double most_reflectance) {
  RadiosityEquation equation{
      nullptr, Eigen::MatrixXd(n, channels), Eigen::MatrixXd(n, channels), Eigen::VectorXd(n), {}};
  double total = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    equation.areas(i) = 1 + std::floor(random.unit() * 7);
    total += equation.areas(i);
    for (Eigen::Index c = 0; c < channels; ++c) {
      const double rho = random.unit(), emission = random.unit();
      equation.reflectance(i, c) = std::floor(rho * most_reflectance * 1024) / 1024;
      equation.emission(i, c) = random.unit() < 0.6 ? 0 : std::floor(emission * 1024) / 16;
    }
  }
  equation.emission.row(0).setConstant(50);
  double whole = 1;
  while (whole < total) whole *= 2;
  equation.areas(n - 1) += whole - total;
  equation.factors =
      std::make_shared<DenseFactors>(RowMatrix(Eigen::VectorXd::Ones(n) * (equation.areas / whole).transpose()));
  return equation;
}

inline DenseVector<CGAL::Gmpq> sphere_truth(const RadiosityEquation& equation, Eigen::Index c) {
  using Rational = CGAL::Gmpq;
  Rational emitted = 0, absorbing = 0;
  for (Eigen::Index j = 0; j < equation.areas.size(); ++j) {
    emitted += Rational(equation.areas(j)) * Rational(equation.emission(j, c));
    absorbing += Rational(equation.areas(j)) * (Rational(1) - Rational(equation.reflectance(j, c)));
  }
  const Rational irradiance = emitted / absorbing;
  DenseVector<Rational> truth(equation.areas.size());
  for (Eigen::Index i = 0; i < truth.size(); ++i) {
    truth(i) = Rational(equation.emission(i, c)) + Rational(equation.reflectance(i, c)) * irradiance;
  }
  return truth;
}

/// One channel of an equation as exact_radiosity() takes it.
inline RadiositySystem channel_of(const RadiosityEquation& equation, Eigen::Index c) {
  return {equation.factors->dense(), equation.reflectance.col(c), equation.emission.col(c)};
}

}  // namespace etendue::validation
