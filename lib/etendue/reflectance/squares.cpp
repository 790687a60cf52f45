// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/squares.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/reflectance/noise.hpp"

namespace etendue {

namespace {

/// Which of `count` parts of [0, 1), which repeats.
std::int64_t part(double share, int count) {
  const double within = share - std::floor(share);  // may round to 1
  return std::min<std::int64_t>(static_cast<std::int64_t>(within * count), count - 1);
}

}  // namespace

Eigen::Array3d colour_of_square(const ColourSquares& squares, const PatternPoint& at) {
  require(squares.columns >= 1 && squares.rows >= 1, "colour_of_square: at least one column and one row");
  require(std::isfinite(at.u) && std::isfinite(at.v), "colour_of_square: the place is finite");
  const std::int64_t column = part(at.u, squares.columns);
  const std::int64_t row = at.v == 1 ? squares.rows - 1 : part(at.v, squares.rows);
  Eigen::Array3d colour;
  for (int channel = 0; channel < 3; ++channel) {
    const std::uint64_t hash = lattice_hash(squares.seed, column, row, channel);
    colour[channel] = static_cast<double>(hash >> 11) * 0x1p-53;
  }
  return colour;
}

}  // namespace etendue
