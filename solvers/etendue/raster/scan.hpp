// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Corners are rounded to a grid of this many steps a pixel; from there on coverage is decided in exact integers.
inline constexpr std::int64_t kSubpixels = 4096;

/// Largest coordinate [pixels] of a corner: with it the products of the edge functions stay below 2^62.
inline constexpr double kLargestCoordinate = 0x1p17;

/// A pixel whose centre lies in a triangle, and the centre's barycentric coordinates there.
struct Covered {
  int column = 0;
  int row = 0;
  std::array<double, 3> weight{};  ///< of the three corners; they sum to one up to rounding
};

/// Calls `body` for each pixel of a columns × rows picture whose centre lies in the triangle, row by row from the top.
/// Coordinates are in pixels from the top-left corner of the picture, rows downwards; either orientation.
///
/// Returns   of triangles that share an edge (same corners) every pixel centre on it belongs to exactly one: to the one
///           that has it as a top or a left edge. Exact, after the rounding of the corners to 1/kSubpixels
/// Contract  |coordinate| ≤ kLargestCoordinate
void scan(const std::array<Vec2, 3>& corners, int columns, int rows, const std::function<void(const Covered&)>& body);

}  // namespace etendue
