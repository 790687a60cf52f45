// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/gauss_legendre.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

constexpr std::size_t first_of(int n) {
  return static_cast<std::size_t>(n * (n - 1) / 2);
}

using Rules = std::array<QuadratureNode, first_of(kMaxGaussNodes + 1)>;

struct Legendre {
  long double value;
  long double derivative;
};

Legendre legendre(int n, long double x) {
  long double previous = 1, value = x;
  for (int k = 2; k <= n; ++k) {
    const long double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (x * value - previous) / (x * x - 1)};
}

// Newton's method from Tricomi's estimate: quadratic, so eight steps are more than enough in extended precision.
Rules compute_rules() {
  constexpr long double kPi = 3.14159265358979323846264338327950288L;
  constexpr int kNewtonSteps = 8;
  Rules rules{};
  rules[0] = {0, 2};
  for (int n = 2; n <= kMaxGaussNodes; ++n) {
    for (int i = 0; i < n; ++i) {
      long double x = -std::cos(kPi * (i + 0.75L) / (n + 0.5L));
      for (int step = 0; step < kNewtonSteps; ++step) {
        const Legendre p = legendre(n, x);
        x -= p.value / p.derivative;
      }
      if (2 * i + 1 == n) x = 0;
      const long double slope = legendre(n, x).derivative;
      rules[first_of(n) + static_cast<std::size_t>(i)] = {static_cast<double>(x),
                                                          static_cast<double>(2 / ((1 - x * x) * slope * slope))};
    }
  }
  return rules;
}

using WideRules = std::array<WideQuadratureNode, first_of(kMaxGaussNodes + 1)>;

/// One more step of Newton's method, in twice the digits, from the nodes above: 2^-63 becomes 2^-110 or so.
WideQuadratureNode refined(int n, double start) {
  DoubleDouble x = start;
  DoubleDouble slope;
  constexpr int kNewtonSteps = 2;
  for (int step = 0; step <= kNewtonSteps; ++step) {
    DoubleDouble previous = 1, value = x;
    for (int k = 2; k <= n; ++k) {
      const DoubleDouble next = (x * value * double(2 * k - 1) - previous * double(k - 1)) / DoubleDouble(k);
      previous = value;
      value = next;
    }
    slope = (x * value - previous) * double(n) / (x * x - DoubleDouble(1));
    if (step < kNewtonSteps && start != 0) x = x - value / slope;
  }
  return {x, DoubleDouble(2) / ((DoubleDouble(1) - x * x) * slope * slope)};
}

WideRules compute_wide_rules() {
  WideRules rules;
  rules[0] = {0, 2};
  for (int n = 2; n <= kMaxGaussNodes; ++n) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      rules[first_of(n) + i] = refined(n, gauss_legendre(n)[i].x);
    }
  }
  return rules;
}

double geometric(int n, double rho) {
  const double decay = 1 / (rho * rho);
  return std::pow(decay, n) / (1 - decay);
}

}  // namespace

std::span<const QuadratureNode> gauss_legendre(int n) {
  require(n >= 1 && n <= kMaxGaussNodes, "gauss_legendre: 1 <= n <= kMaxGaussNodes");
  static const Rules rules = compute_rules();
  return {rules.data() + first_of(n), static_cast<std::size_t>(n)};
}

std::span<const WideQuadratureNode> wide_gauss_legendre(int n) {
  require(n >= 1 && n <= kMaxGaussNodes, "wide_gauss_legendre: 1 <= n <= kMaxGaussNodes");
  static const WideRules rules = compute_wide_rules();
  return {rules.data() + first_of(n), static_cast<std::size_t>(n)};
}

double legendre_remainder(int n) {
  require(n >= 1 && n <= kMaxGaussNodes, "legendre_remainder: 1 <= n <= kMaxGaussNodes");
  double c = 2;  // n = 0; the quotient of two that follow one another is (n/(2n − 1))² (2n − 1)/(2n + 1)
  for (int k = 1; k <= n; ++k) c *= static_cast<double>(k) * k / ((2.0 * k - 1) * (2.0 * k + 1));
  return c;
}

double logarithmic_truncation(int n, double rho) {
  return 32.0 / 15 / n * geometric(n, rho);
}

double analytic_truncation(int n, double rho) {
  return 64.0 / 15 * geometric(n, rho);
}

}  // namespace etendue
