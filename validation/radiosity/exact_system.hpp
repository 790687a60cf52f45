// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CGAL/Gmpq.h>

#include "etendue/linear/gaussian_elimination.hpp"
#include "etendue/radiosity/system.hpp"

namespace etendue::validation {

/// The solution of B = E + diag(ρ) F B over the rationals. It is checked by substitution into 6-7, so it does not
/// matter that our own elimination found it.
inline DenseVector<CGAL::Gmpq> exact_radiosity(const RadiositySystem& system) {
  using Rational = CGAL::Gmpq;
  const Eigen::Index n = system.emission.size();
  DenseMatrix<Rational> matrix(n, n);
  DenseVector<Rational> emission(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    emission(i) = Rational(system.emission(i));
    for (Eigen::Index j = 0; j < n; ++j) {
      matrix(i, j) = Rational(i == j ? 1 : 0) - Rational(system.reflectance(i)) * Rational(system.form_factors(i, j));
    }
  }
  auto solved = gaussian_elimination<Rational>(matrix, emission);
  const DenseVector<Rational>& radiosity = solved.value();
  for (Eigen::Index i = 0; i < n; ++i) {
    Rational incident = 0;
    for (Eigen::Index j = 0; j < n; ++j) incident += Rational(system.form_factors(i, j)) * radiosity(j);
    require(radiosity(i) == emission(i) + Rational(system.reflectance(i)) * incident, "exact_radiosity: solves 6-7");
  }
  return radiosity;
}

/// max_i |B_i − exact B_i|, rounded once.
inline double true_error(const Eigen::VectorXd& radiosity, const DenseVector<CGAL::Gmpq>& exact) {
  CGAL::Gmpq worst = 0;
  for (Eigen::Index i = 0; i < radiosity.size(); ++i) {
    const CGAL::Gmpq difference = CGAL::Gmpq(radiosity(i)) - exact(i);
    worst = std::max(worst, difference < 0 ? CGAL::Gmpq(-difference) : difference);
  }
  return CGAL::to_double(worst);
}

}  // namespace etendue::validation
