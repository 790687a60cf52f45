// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/double_double.hpp"
#include "etendue/core/floating_point.hpp"

namespace etendue {

/// One node of a quadrature rule on [−1, 1].
struct QuadratureNode {
  double x = 0;
  double weight = 0;
};

inline constexpr int kMaxGaussNodes = 32;

/// The n-point Gauss-Legendre rule on [−1, 1], exact for polynomials of degree 2n − 1.
///
/// Domain    1 ≤ n ≤ kMaxGaussNodes
/// Accuracy  nodes and weights are rounded from extended precision: within one unit in the last place, measured
/// Errors    ContractViolation when n is out of range
[[nodiscard]] std::span<const QuadratureNode> gauss_legendre(int n);

/// The rule errs by this times f^(2n)/(2n)! at some point of (−1, 1): c_n = 2^(2n+1) (n!)⁴/((2n+1) ((2n)!)²), the squared
/// norm of the n-th monic Legendre polynomial.
[[nodiscard]] double legendre_remainder(int n);

/// A node in twice the digits.
struct WideQuadratureNode {
  DoubleDouble x;
  DoubleDouble weight;
};

/// Accuracy  nodes and weights within 2^-98: Newton's method ends where its step is lost in the rounding; measured
[[nodiscard]] std::span<const WideQuadratureNode> wide_gauss_legendre(int n);

/// Bounds |∫ f − rule f| over [−1, 1] where f's Chebyshev coefficients obey |a_k| ≤ (2/k) rho^(−k):
/// (32/15)/n · rho^(−2n)/(1 − rho^(−2)); derivation in NOTES.md §2.
[[nodiscard]] double logarithmic_truncation(int n, double rho);

/// The same where |f| ≤ 1 on the Bernstein ellipse rho: (64/15) rho^(−2n)/(1 − rho^(−2)); NOTES.md §2.
[[nodiscard]] double analytic_truncation(int n, double rho);

}  // namespace etendue
