// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

inline constexpr int kMostDifferenceNodes = 24;

/// The n-point Gauss rule for what depends only on the difference w = x − y of two points of [−1, 1]:
///
///     ∫∫ f(x − y) dx dy = ∫ (2 − |w|) f(w) dw  over [−2, 2]
///
/// exact for polynomials of degree 2n − 1, with n nodes where a product rule of that degree takes n².
///
/// Domain    1 ≤ n ≤ kMostDifferenceNodes
/// Accuracy  nodes and weights are rounded from extended precision: within one unit in the last place, measured
/// Errors    ContractViolation when n is out of range
/// Source    Gautschi 1982 for Stieltjes' procedure
[[nodiscard]] std::span<const QuadratureNode> gauss_difference(int n);

/// The rule errs by this times f^(2n)/(2n)! at some point of (−2, 2): the squared norm of the n-th monic orthogonal
/// polynomial for the weight 2 − |w|; NOTES.md §8.
[[nodiscard]] double difference_remainder(int n);

}  // namespace etendue
