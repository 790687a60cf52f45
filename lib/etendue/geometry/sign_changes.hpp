// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "etendue/core/double_double.hpp"

namespace etendue {

/// A polynomial of degree at most 4, lowest coefficient first, each known to within its error.
struct BoundedPolynomial {
  static constexpr std::size_t kMostDegree = 4;
  std::array<DoubleDouble, kMostDegree + 1> coefficient{};
  std::array<double, kMostDegree + 1> error{};
};

/// A number x with |x − zero| ≤ error.
struct BoundedZero {
  DoubleDouble x;
  double error = 0;
};

struct SignChanges {
  std::array<BoundedZero, BoundedPolynomial::kMostDegree> zero;
  std::size_t count = 0;
};

/// Numbers between `low` and `high` where the polynomial changes its sign, in ascending order.
///
/// Between two neighbouring zeros of its derivative, found in the same way, a polynomial is monotone: there it changes
/// its sign once or not at all, and the signs at the ends tell. A double zero (a ray that is tangent) is no change.
///
/// Accuracy  each error is proved: the polynomial's sign is certain, and differs, at x ± error. Where it stays so near
///           zero at an extremum that no sign is certain (within the coefficients' errors and 2^-98 of the terms), it
///           counts as touching zero there: two zeros with less than that between them are none
/// Domain    finite, low < high; coefficients and their products with the powers of low and high between 2^-900 and
///           2^900, or zero
/// Source    elementary (Rolle); geometry/NOTES.md §10
[[nodiscard]] SignChanges sign_changes(const BoundedPolynomial& polynomial, double low, double high);

}  // namespace etendue
