// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// A whole number of any length: what decides where doubles cannot, however far apart their exponents are.
///
/// Accuracy  exact; nothing over- or underflows
class Integer {
 public:
  Integer() = default;

  /// value / 2^exponent.
  /// Domain    finite; exponent ≤ exponent_of(value), so that the quotient is whole
  static Integer scaled(double value, int exponent);
  /// The greatest exponent by which every double of this size can be scaled: 2^-52 of its leading bit; 0 of zero.
  static int exponent_of(double value);

  [[nodiscard]] int sign() const { return limbs_.empty() ? 0 : negative_ ? -1 : 1; }

  friend Integer operator-(Integer a);
  friend Integer operator+(const Integer& a, const Integer& b);
  friend Integer operator-(const Integer& a, const Integer& b);
  friend Integer operator*(const Integer& a, const Integer& b);

 private:
  using Limbs = std::vector<std::uint32_t>;  // least significant first, no zeros at the end
  static Limbs sum(const Limbs& a, const Limbs& b);
  static Limbs difference(const Limbs& greater, const Limbs& less);
  static bool is_less(const Limbs& a, const Limbs& b);

  Limbs limbs_;
  bool negative_ = false;
};

}  // namespace etendue
