// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "etendue/form_factor/critical_lines.hpp"

namespace etendue {

/// A line that comes nearer than this share of a cell's size to its outline is not drawn: the strip would hold nothing
/// that counts, and be of the corners' rounding.
inline constexpr double kTouch = 0x1p-40;

/// A convex polygon in the source's plane, counter-clockwise.
class Cell {
 public:
  static constexpr int kMostCorners = 12;

  /// Fans out what has too many corners to be cut further.
  static std::vector<Cell> from(std::span<const Vec2> corners);

  int size() const { return size_; }
  const Vec2& operator[](int i) const { return corners_[static_cast<std::size_t>(i)]; }
  std::span<const Vec2> corners() const { return {corners_.data(), static_cast<std::size_t>(size_)}; }
  double area() const;
  Vec2 centre() const;
  /// No corner is farther than this from the first.
  double reach() const;
  /// The longest distance between two corners, and the vector.
  Vec2 longest() const;

  /// The parts on either side of the line; one of them empty where it does not pass between the corners.
  struct Halves;
  Halves cut(const Vec2& normal, double level) const;

  void add(const Vec2& corner) { corners_[static_cast<std::size_t>(size_++)] = corner; }

 private:
  std::array<Vec2, kMostCorners> corners_;
  int size_ = 0;
};

struct Cell::Halves {
  Cell above, below;
};

/// Whether the stretch of the line passes through the inside of the cell. Along a cell's own side, by rounding, it does
/// not (kTouch).
[[nodiscard]] bool crosses(const CriticalLine& line, const Cell& cell);

/// The zone cut along every critical line, each cell by the whole line where the stretch meets it: no line passes through
/// the inside of a cell, however thin the cells become.
[[nodiscard]] std::vector<Cell> cells_between(std::span<const Vec2> zone, std::span<const CriticalLine> lines);

}  // namespace etendue
