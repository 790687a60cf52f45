// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "etendue/geometry/expansion.hpp"

namespace etendue {

/// Below this share of the terms it was summed from, a DoubleDouble is recomputed exactly. Sums of at most 16 u² error
/// then keep a relative error of 2^-101 / 2^-44 = 2^-57 (NOTES.md §3).
inline constexpr double kResolved = 0x1p-44;

/// Bound on the relative error of t wherever it is a quotient of resolved numbers; proved, NOTES.md §3.
inline constexpr double kMeetingError = 0x1p-55;

/// `value` where it is large against `scale`, the sum of the magnitudes that made it; else the number `exact()`
/// returns. The sign is exact, the relative error at most 2^-57.
template <class Exact>
[[nodiscard]] DoubleDouble resolved(const DoubleDouble& value, double scale, Exact exact) {
  if (std::abs(value.high) > kResolved * scale) return value;
  const Expansion number = exact();
  return number.to_double_double();
}

}  // namespace etendue
