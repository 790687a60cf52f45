// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Where the k-th of the lines lies that divide an edge into `count` parts, as a share of it: even, or denser towards both
/// ends, where radiosity changes fastest.
///
///     s(u) = (1 − g) u + g (1 − cos πu)/2,   u = k/count
///
/// Symbols   g grading in [0, 1]: 0 even; 1 as Chebyshev's points lie, outermost parts some 2.5/count² wide
/// Returns   exactly 0 and 1 at the ends, growing in between. A function of k/count alone: every other line of twice as many
///           is a line
[[nodiscard]] inline double division_line(std::int64_t k, std::int64_t count, double grading) {
  const double u = static_cast<double>(k) / static_cast<double>(count);
  if (grading == 0 || k == 0 || k == count) return u;
  return (1 - grading) * u + grading * (0.5 - 0.5 * std::cos(std::numbers::pi * u));
}

}  // namespace etendue
