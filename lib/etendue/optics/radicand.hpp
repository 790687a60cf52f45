// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/double_double.hpp"

namespace etendue {

/// The radicand of IU.5-7, multiplied by `lengths`: its sign decides total internal reflection.
///
///     q = η² cos²θ + (1 − η)(1 + η) = 1 − η² sin²θ
///
/// In the first form nothing cancels for η ≤ 1, and for η > 1 only what is physical: the way to the critical angle.
/// Symbols   dot² = cos²θ · lengths; lengths = |δ|²|s|², which is 1 for exact unit vectors
/// Accuracy  4 u² relatively on top of the arguments' errors in each of the two terms, NOTES.md §3
inline DoubleDouble refraction_radicand(const DoubleDouble& dot_squared, const DoubleDouble& lengths, double eta) {
  const DoubleDouble curvature = exact_sum(1, -eta) * exact_sum(1, eta);
  return exact_product(eta, eta) * dot_squared + curvature * lengths;
}

}  // namespace etendue
