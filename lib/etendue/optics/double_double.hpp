// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// The unevaluated sum high + low with |low| ≤ ulp(high)/2: twice the digits of a double, from error-free
/// transformations. Bounds, with u = 2^-53 and no overflow: Joldes, Muller and Popescu 2017 (sum), Muller and Rideau
/// 2022 (product). Products that underflow lose at most 2^-1074 each, which the users' domains keep below every bound.
struct DoubleDouble {
  double high = 0;
  double low = 0;
};

/// a + b exactly, for |a| ≥ |b| or a = 0.
inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b exactly.
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a · b exactly.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// Relative error at most 3 u² + 13 u³, whatever the signs.
inline DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble high = two_sum(x.high, y.high);
  const DoubleDouble low = two_sum(x.low, y.low);
  const DoubleDouble sum = fast_two_sum(high.high, high.low + low.high);
  return fast_two_sum(sum.high, low.low + sum.low);
}

/// Relative error at most 4 u².
inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble high = two_product(x.high, y.high);
  const double low = std::fma(x.low, y.high, std::fma(x.high, y.low, x.low * y.low));
  return fast_two_sum(high.high, high.low + low);
}

/// Scalar product with an error of at most 6.1 u² |x| |y|: two sums, each of a partial product that is no longer than
/// that.
inline DoubleDouble dot_twice(const Vec3& x, const Vec3& y) {
  return (two_product(x.x(), y.x()) + two_product(x.y(), y.y())) + two_product(x.z(), y.z());
}

/// a b − c d with a relative error of at most 2 u, however much cancels (Jeannerod, Louvet and Muller 2013).
inline double difference_of_products(double a, double b, double c, double d) {
  const double subtrahend = c * d;
  return std::fma(a, b, -subtrahend) - std::fma(c, d, -subtrahend);
}

/// x × y with a relative error of at most 2 u in each component.
inline Vec3 cross_accurately(const Vec3& x, const Vec3& y) {
  return {difference_of_products(x.y(), y.z(), x.z(), y.y()), difference_of_products(x.z(), y.x(), x.x(), y.z()),
          difference_of_products(x.x(), y.y(), x.y(), y.x())};
}

}  // namespace etendue
