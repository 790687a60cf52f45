// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// A computed number and a bound on its absolute error: |value − truth| ≤ bound.
/// Whether the bound is proved or measured is said where the number is made.
struct Bounded {
  double value = 0;
  double bound = 0;
};

/// What a caller asks for: |error| ≤ max(absolute, relative · |value|).
struct Tolerance {
  double relative = 1e-12;
  double absolute = 0;
};

}  // namespace etendue
