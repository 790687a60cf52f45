// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Corners are rounded to a grid of this many steps a pixel; from there on coverage is decided in exact integers.
inline constexpr std::int64_t kSubpixels = 4096;

/// Largest coordinate [pixels] of a corner: with it the products of the edge functions stay below 2^62.
inline constexpr double kLargestCoordinate = 0x1p17;

/// A part of the pixel grid: columns [0, columns), rows [first_row, last_row), counted from the picture's top-left corner.
struct ScanWindow {
  int columns = 0, first_row = 0, last_row = 0;
};

/// The pixels [begin, end) of a row whose centres lie in a triangle.
struct Span {
  int row = 0, begin = 0, end = 0;
  /// Barycentric coordinates of the first one's centre, times TriangleSpans::area(): exact.
  std::array<std::int64_t, 3> weight{};
};

/// The rows of pixels whose centres lie in a triangle, from the top. Coordinates are in pixels from the top-left corner of
/// the picture, rows downwards; either orientation.
///
/// Returns   of triangles that share an edge (same corners) every pixel centre on it belongs to exactly one: to the one
///           that has it as a top or a left edge. Exact, after the rounding of the corners to 1/kSubpixels
/// Contract  |coordinate| ≤ kLargestCoordinate
class TriangleSpans {
 public:
  TriangleSpans(const std::array<Vec2, 3>& corners, const ScanWindow& window);

  /// The next row that has a pixel, or false.
  bool next(Span& span) {
    while (row_ < last_row_) {
      const auto [left, right, third] = order_;
      std::int64_t begin = std::max<std::int64_t>(edges_[left].bound, 0), end = std::min(edges_[right].bound, columns_);
      if (third_is_right_) {
        end = std::min(end, edges_[third].bound);
      } else {
        begin = std::max(begin, edges_[third].bound);
      }
      const bool found = begin < end;
      if (found) {
        span.row = row_;
        span.begin = static_cast<int>(begin);
        span.end = static_cast<int>(end);
        for (std::size_t k = 0; k < 3; ++k) span.weight[k] = edges_[k].value + edges_[k].across * begin;
      }
      ++row_;
      for (Edge& edge : edges_) edge.advance();
      if (found) return true;
    }
    return false;
  }

  /// What weights are divided by.
  double area() const { return area_; }
  /// By how much a weight grows from one pixel to the next in a row.
  std::int64_t step(std::size_t corner) const { return edges_[corner].across; }

 private:
  /// A side of the triangle. Its function value + across · column is at least `least` on the inner side.
  struct Edge {
    std::int64_t value = 0;         // at the centre of column 0 in the row
    std::int64_t across = 0;        // growth a column
    std::int64_t down = 0;          // growth a row
    std::int64_t least = 0;         // 0 where the edge owns its points, 1 otherwise
    std::int64_t bound = 0;         // first column of a left edge, one past the last of a right edge; 0 of a level one
    std::int64_t remainder = 0;     // of the division that bound is
    std::int64_t bound_growth = 0;  // of bound a row, rounded down
    std::int64_t rest_growth = 0;   // of remainder
    std::int64_t divisor = 1;       // |across|

    void begin();
    void advance() {
      value += down;
      bound += bound_growth;
      remainder += rest_growth;
      if (remainder >= divisor) {
        remainder -= divisor;
        ++bound;
      }
    }
  };

  std::array<Edge, 3> edges_;                   // opposite to the corners, as the caller counts these
  std::array<std::uint8_t, 3> order_{0, 1, 2};  // a left one, a right one, and the third
  bool third_is_right_ = false;
  double area_ = 1;
  int row_ = 0, last_row_ = 0;
  std::int64_t columns_ = 0;
};

/// A pixel whose centre lies in a triangle, and the centre's barycentric coordinates there.
struct Covered {
  int column = 0;
  int row = 0;
  std::array<double, 3> weight{};  ///< of the three corners; they sum to one up to rounding
};

/// Calls `body` for each pixel of TriangleSpans in a columns × rows picture.
void scan(const std::array<Vec2, 3>& corners, int columns, int rows, const std::function<void(const Covered&)>& body);

}  // namespace etendue
