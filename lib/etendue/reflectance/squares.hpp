// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/reflectance/mapping.hpp"

namespace etendue {

/// Squares of random colours, columns × rows of them from one edge of the pattern to the other.            @eq IU.4-1, IU.f21
struct ColourSquares {
  int columns = 16;
  int rows = 16;
  std::uint64_t seed = 0;
};

/// Red, green and blue in [0, 1] of the square ⌊u columns⌋ modulo columns, ⌊v rows⌋ modulo rows: independent and uniform.
///
/// Domain    finite u, v; columns, rows ≥ 1
/// Returns   at v = 1 exactly, where a sphere has its pole, the last row
/// Accuracy  a point within rounding of the line between two squares may count to either
[[nodiscard]] Eigen::Array3d colour_of_square(const ColourSquares& squares, const PatternPoint& at);

}  // namespace etendue
