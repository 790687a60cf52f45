// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// An unevaluated sum high + low with |low| ≤ u |high|: about 106 bits.
///
/// Every operation below is written with std::fma or error-free sums, so its result does not depend on whether the
/// compiler contracts. With u = 2^-53 each of +, −, ·, / and sqrt errs by less than 16 u² = 2^-102 relatively
/// (Joldes, Muller and Popescu 2017, theorems 3.1, 4.1, 5.1, 5.3, 6.1); geometry/NOTES.md §1.
/// Domain    results and their rounding errors between 2^-1000 and 2^1000 in magnitude, or zero
struct DoubleDouble {
  double high = 0;
  double low = 0;

  DoubleDouble() = default;
  DoubleDouble(double value) : high(value) {}
  DoubleDouble(double h, double l) : high(h), low(l) {}
};

/// Bound on the relative error of one operation on DoubleDouble; proved, see above.
inline constexpr double kDoubleDoubleError = 0x1p-102;

/// a + b exactly (Knuth).
inline DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a + b exactly where |a| ≥ |b| or a = 0 (Dekker).
inline DoubleDouble exact_ordered_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a − b exactly.
inline DoubleDouble exact_difference(double a, double b) {
  return exact_sum(a, -b);
}

/// a · b exactly.
inline DoubleDouble exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.high, -a.low};
}

/// Relative error at most 3 u² + 13 u³, whatever the signs (Joldes, Muller and Popescu 2017).
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = exact_sum(a.high, b.high);
  const DoubleDouble low = exact_sum(a.low, b.low);
  const DoubleDouble first = exact_ordered_sum(high.high, high.low + low.high);
  return exact_ordered_sum(first.high, low.low + first.low);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + (-b);
}

inline DoubleDouble operator*(const DoubleDouble& a, double b) {
  const DoubleDouble high = exact_product(a.high, b);
  return exact_ordered_sum(high.high, std::fma(a.low, b, high.low));
}

/// Relative error at most 4 u² (Muller and Rideau 2022).
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = exact_product(a.high, b.high);
  const double cross = std::fma(a.low, b.high, std::fma(a.high, b.low, a.low * b.low));
  return exact_ordered_sum(high.high, high.low + cross);
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * first;
  return exact_ordered_sum(first, rest.high / b.high);
}

/// Square root of a value ≥ 0.
inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (a.high <= 0) return {};
  const double root = std::sqrt(a.high);
  const double rest = std::fma(-root, root, a.high) + a.low;
  return exact_ordered_sum(root, rest / (2 * root));
}

inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.high < b.high || (a.high == b.high && a.low < b.low);
}

/// Nearest double.
inline double rounded(const DoubleDouble& a) {
  return a.high + a.low;
}

}  // namespace etendue
