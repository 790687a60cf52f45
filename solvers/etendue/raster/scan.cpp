// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/scan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

struct Point {
  std::int64_t x, y;
};

Point snapped(const Vec2& corner) {
  require(std::abs(corner.x()) <= kLargestCoordinate && std::abs(corner.y()) <= kLargestCoordinate,
          "scan: corners lie within kLargestCoordinate");
  return {std::llround(corner.x() * static_cast<double>(kSubpixels)),
          std::llround(corner.y() * static_cast<double>(kSubpixels))};
}

// Twice the signed area of (from, to, point); positive on the inner side of a triangle wound like x towards y.
std::int64_t edge(const Point& from, const Point& to, const Point& point) {
  return (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x);
}

// Rows grow downwards: with positive area a left edge runs up, a top edge runs to the right.
bool owns_its_points(const Point& from, const Point& to) {
  return to.y < from.y || (to.y == from.y && to.x > from.x);
}

// Index of the first pixel whose centre is not before `coordinate`.
int first_pixel(std::int64_t coordinate, int count) {
  const std::int64_t shifted = coordinate - kSubpixels / 2;
  const std::int64_t up = shifted > 0 ? (shifted + kSubpixels - 1) / kSubpixels : 0;
  return static_cast<int>(std::min<std::int64_t>(up, count));
}

}  // namespace

void scan(const std::array<Vec2, 3>& corners, int columns, int rows, const std::function<void(const Covered&)>& body) {
  std::array<Point, 3> p{snapped(corners[0]), snapped(corners[1]), snapped(corners[2])};
  std::array<std::size_t, 3> original{0, 1, 2};
  if (edge(p[0], p[1], p[2]) < 0) {
    std::swap(p[1], p[2]);
    std::swap(original[1], original[2]);
  }
  const std::int64_t area = edge(p[0], p[1], p[2]);
  if (area == 0) return;

  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  const int last_column = first_pixel(right + 1, columns);
  const int last_row = first_pixel(bottom + 1, rows);
  std::array<std::int64_t, 3> least{};  // what the edge function must reach: 0 on an owned edge, 1 otherwise
  for (std::size_t k = 0; k < 3; ++k) least[k] = owns_its_points(p[(k + 1) % 3], p[(k + 2) % 3]) ? 0 : 1;

  for (int row = first_pixel(top, rows); row < last_row; ++row) {
    for (int column = first_pixel(left, columns); column < last_column; ++column) {
      const Point centre{column * kSubpixels + kSubpixels / 2, row * kSubpixels + kSubpixels / 2};
      Covered pixel{column, row, {}};
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {  // the edge opposite to corner k
        const std::int64_t value = edge(p[(k + 1) % 3], p[(k + 2) % 3], centre);
        inside = inside && value >= least[k];
        pixel.weight[original[k]] = static_cast<double>(value) / static_cast<double>(area);
      }
      if (inside) body(pixel);
    }
  }
}

}  // namespace etendue
