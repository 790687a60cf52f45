// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/scan.hpp"

#include <cmath>
#include <utility>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

struct Point {
  std::int64_t x, y;
};

// To the nearest whole number, ties to even: added, 1.5 · 2^52 has its last place there. |value| ≤ 2^29.
std::int64_t nearest(double value) {
  constexpr double kLastPlaceIsOne = 0x1.8p52;
  return static_cast<std::int64_t>((value + kLastPlaceIsOne) - kLastPlaceIsOne);
}

Point snapped(const Vec2& corner) {
  require(std::abs(corner.x()) <= kLargestCoordinate && std::abs(corner.y()) <= kLargestCoordinate,
          "scan: corners lie within kLargestCoordinate");
  return {nearest(corner.x() * static_cast<double>(kSubpixels)), nearest(corner.y() * static_cast<double>(kSubpixels))};
}

// Twice the signed area of (from, to, point); positive on the inner side of a triangle wound like x towards y.
std::int64_t edge_value(const Point& from, const Point& to, const Point& point) {
  return (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x);
}

// Rows grow downwards: with positive area a left edge runs up, a top edge runs to the right.
bool owns_its_points(const Point& from, const Point& to) {
  return to.y < from.y || (to.y == from.y && to.x > from.x);
}

// Index of the first pixel, from `first` to `last`, whose centre is not before `coordinate`.
int first_pixel(std::int64_t coordinate, int first, int last) {
  const std::int64_t shifted = coordinate - kSubpixels / 2;
  const std::int64_t up = shifted > 0 ? (shifted + kSubpixels - 1) / kSubpixels : 0;
  return static_cast<int>(std::clamp<std::int64_t>(up, first, last));
}

struct Quotient {
  std::int64_t floor, rest;  // rest in [0, divisor)
};
// By a division of doubles, whose quotient, below 2^50, is off by one at most, and put right in whole numbers: several times
// as fast as a division of these.
Quotient divided(std::int64_t value, std::int64_t divisor) {
  Quotient result{static_cast<std::int64_t>(static_cast<double>(value) / static_cast<double>(divisor)), 0};
  result.rest = value - result.floor * divisor;
  while (result.rest < 0) {
    result.rest += divisor;
    --result.floor;
  }
  while (result.rest >= divisor) {
    result.rest -= divisor;
    ++result.floor;
  }
  return result;
}

}  // namespace

// On a left edge the first column inside is ⌈(least − value) / across⌉, on a right one the last is
// ⌊(value − least) / −across⌋: quotients that change from row to row by a constant numerator, so that they are kept with
// their remainders and never divided again.
void TriangleSpans::Edge::begin() {
  if (across == 0) return;
  divisor = across > 0 ? across : -across;
  const Quotient first =
      across > 0 ? divided(least - value + divisor - 1, divisor) : divided(value - least + divisor, divisor);
  const Quotient growth = divided(across > 0 ? -down : down, divisor);
  bound = first.floor;
  remainder = first.rest;
  bound_growth = growth.floor;
  rest_growth = growth.rest;
}

TriangleSpans::TriangleSpans(const std::array<Vec2, 3>& corners, const ScanWindow& window) : columns_(window.columns) {
  std::array<Point, 3> p{snapped(corners[0]), snapped(corners[1]), snapped(corners[2])};
  std::array<std::size_t, 3> original{0, 1, 2};
  std::int64_t area = edge_value(p[0], p[1], p[2]);
  if (area < 0) {
    std::swap(p[1], p[2]);
    std::swap(original[1], original[2]);
    area = -area;
  }
  if (area == 0) return;
  area_ = static_cast<double>(area);
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  if (first_pixel(left, 0, window.columns) >= first_pixel(right + 1, 0, window.columns)) return;
  row_ = first_pixel(top, window.first_row, window.last_row);
  last_row_ = first_pixel(bottom + 1, window.first_row, window.last_row);
  for (std::size_t k = 0; k < 3; ++k) {  // a level side at the bottom has no pixel: what its centres lie on ends before
    if (p[k].y == bottom && p[(k + 1) % 3].y == bottom)
      last_row_ = first_pixel(bottom, window.first_row, window.last_row);
  }
  if (row_ >= last_row_) return;
  const Point centre{kSubpixels / 2, row_ * kSubpixels + kSubpixels / 2};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point &from = p[(k + 1) % 3], &to = p[(k + 2) % 3];
    Edge& edge = edges_[original[k]];
    edge.value = edge_value(from, to, centre);
    edge.across = (from.y - to.y) * kSubpixels;
    edge.down = (to.x - from.x) * kSubpixels;
    edge.least = owns_its_points(from, to) ? 0 : 1;
    edge.begin();
  }
  const auto is = [&](auto condition) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      if (condition(edges_[k].across)) return k;
    }
    return std::uint8_t{0};
  };
  order_[0] = is([](std::int64_t across) { return across > 0; });
  order_[1] = is([](std::int64_t across) { return across < 0; });
  order_[2] = static_cast<std::uint8_t>(3 - order_[0] - order_[1]);
  third_is_right_ = edges_[order_[2]].across < 0;
}

void scan(const std::array<Vec2, 3>& corners, int columns, int rows, const std::function<void(const Covered&)>& body) {
  TriangleSpans spans(corners, {columns, 0, rows});
  for (Span span; spans.next(span);) {
    for (int column = span.begin; column < span.end; ++column) {
      Covered pixel{column, span.row, {}};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t value = span.weight[k] + spans.step(k) * (column - span.begin);
        pixel.weight[k] = static_cast<double>(value) / spans.area();
      }
      body(pixel);
    }
  }
}

}  // namespace etendue
