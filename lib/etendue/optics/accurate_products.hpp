// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/double_double.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Scalar product with an error of at most 6.1 u² |x| |y|: two sums, each of a partial product that is no longer than
/// that. Products that underflow lose at most 2^-1074 each, which the users' domains keep below every bound.
inline DoubleDouble dot_twice(const Vec3& x, const Vec3& y) {
  return (exact_product(x.x(), y.x()) + exact_product(x.y(), y.y())) + exact_product(x.z(), y.z());
}

/// x × y with a relative error of at most 2 u in each component, however much cancels (Jeannerod, Louvet and Muller 2013).
inline Vec3 cross_accurately(const Vec3& x, const Vec3& y) {
  const auto difference = [](double a, double b, double c, double d) {  // a b − c d
    const double subtrahend = c * d;
    return std::fma(a, b, -subtrahend) - std::fma(c, d, -subtrahend);
  };
  return {difference(x.y(), y.z(), x.z(), y.y()), difference(x.z(), y.x(), x.x(), y.z()),
          difference(x.x(), y.y(), x.y(), y.x())};
}

}  // namespace etendue
