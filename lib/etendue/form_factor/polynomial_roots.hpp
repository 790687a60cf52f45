// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// A polynomial of degree at most 4, lowest coefficient first.
using Quartic = std::array<double, 5>;

/// Adds to `roots`, in ascending order, the numbers strictly between `low` and `high` where the polynomial changes its
/// sign. Between two neighbouring zeros of the derivative, found in the same way, it is monotone: no change is missed
/// but those that rounding of the polynomial's value hides, pairs of roots so close that it barely leaves zero.
///
/// Accuracy  of single roots: a few units in the last place of the polynomial's rounding over its slope; measured
void add_sign_changes(const Quartic& polynomial, double low, double high, std::vector<double>& roots);

}  // namespace etendue
