// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/core/double_double.hpp"

namespace etendue {

/// A real number held exactly, as a sum of doubles that do not overlap (smallest first, no zeros).
///
/// Sums, differences and products are exact: the last resort of a decision that double and DoubleDouble leave open.
/// Domain    no partial product over- or underflows; lengths between 2^-200 and 2^200 are safe for every use here
/// Accuracy  exact; to_double_double() errs by at most 2^-102 relatively
/// Source    Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic (grow-expansion, scale-expansion)
class Expansion {
 public:
  Expansion() = default;
  Expansion(double value);
  Expansion(const DoubleDouble& value);

  /// Adds a · b: as a sum of products does, without expansions of its own for each.
  void add_product(const DoubleDouble& a, const DoubleDouble& b);

  [[nodiscard]] int sign() const;  ///< −1, 0 or 1
  [[nodiscard]] DoubleDouble to_double_double() const;

  friend Expansion operator-(Expansion a);
  friend Expansion operator+(const Expansion& a, const Expansion& b);
  friend Expansion operator-(const Expansion& a, const Expansion& b);
  friend Expansion operator*(const Expansion& a, const Expansion& b);

 private:
  void grow(double term);
  std::vector<double> terms_;
};

}  // namespace etendue
