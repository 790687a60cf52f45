// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etendue {

std::vector<Cell> Cell::from(std::span<const Vec2> corners) {
  // A cell gains at most one corner a cut, and halving takes it down again: a third of the room is left for that.
  constexpr std::size_t kStart = 8;
  std::vector<Cell> cells;
  for (std::size_t i = 1; i + 1 < corners.size();) {
    Cell cell;
    cell.add(corners[0]);
    const std::size_t last = std::min(corners.size() - 1, i + kStart - 2);
    for (std::size_t k = i; k <= last; ++k) cell.add(corners[k]);
    cells.push_back(cell);
    i = last;
  }
  return cells;
}

double Cell::area() const {
  double twice = 0;
  for (int i = 1; i + 1 < size_; ++i) {
    const Vec2 a = (*this)[i] - (*this)[0], b = (*this)[i + 1] - (*this)[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

Vec2 Cell::centre() const {
  Vec2 sum = Vec2::Zero();
  for (int i = 0; i < size_; ++i) sum += (*this)[i];
  return sum / size_;
}

double Cell::reach() const {
  double reach = 0;
  for (int i = 1; i < size_; ++i) reach = std::max(reach, ((*this)[i] - (*this)[0]).cwiseAbs().sum());
  return reach;
}

Vec2 Cell::longest() const {
  Vec2 longest = Vec2::Zero();
  for (int i = 0; i < size_; ++i) {
    for (int j = 0; j < i; ++j) {
      const Vec2 across = (*this)[i] - (*this)[j];
      if (across.squaredNorm() > longest.squaredNorm()) longest = across;
    }
  }
  return longest;
}

Cell::Halves Cell::cut(const Vec2& normal, double level) const {
  Halves halves;
  std::array<double, kMostCorners> heights{};
  for (int i = 0; i < size_; ++i) heights[static_cast<std::size_t>(i)] = normal.dot((*this)[i]) - level;
  for (int i = 0; i < size_; ++i) {
    const int j = i + 1 < size_ ? i + 1 : 0;
    const double h = heights[static_cast<std::size_t>(i)], next = heights[static_cast<std::size_t>(j)];
    if (h >= 0) halves.above.add((*this)[i]);
    if (h <= 0) halves.below.add((*this)[i]);
    if ((h > 0 && next < 0) || (h < 0 && next > 0)) {
      const Vec2 corner = (*this)[i] + h / (h - next) * ((*this)[j] - (*this)[i]);
      halves.above.add(corner);
      halves.below.add(corner);
    }
  }
  if (halves.above.size() < 3) halves.above.size_ = 0;
  if (halves.below.size() < 3) halves.below.size_ = 0;
  return halves;
}

bool crosses(const CriticalLine& line, const Cell& cell) {
  double below = 0, above = 0;
  std::array<double, Cell::kMostCorners> heights{};
  for (int i = 0; i < cell.size(); ++i) {
    const double h = line.height(cell[i]);
    heights[static_cast<std::size_t>(i)] = h;
    below = std::min(below, h);
    above = std::max(above, h);
  }
  if (!(below < 0 && above > 0)) return false;
  const double reach = cell.reach();
  if (std::min(-below, above) <= kTouch * reach) return false;
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (int i = 0; i < cell.size(); ++i) {
    const int j = i + 1 < cell.size() ? i + 1 : 0;
    const double h = heights[static_cast<std::size_t>(i)], next = heights[static_cast<std::size_t>(j)];
    if ((h > 0) == (next > 0)) continue;
    const double at = line.along(cell[i] + h / (h - next) * (cell[j] - cell[i]));
    first = std::min(first, at);
    last = std::max(last, at);
  }
  return std::min(last, line.end) - std::max(first, line.begin) > kTouch * reach;
}

std::vector<Cell> cells_between(std::span<const Vec2> zone, std::span<const CriticalLine> lines) {
  std::vector<Cell> cells = Cell::from(zone);
  cells.reserve(cells.size() + 2 * lines.size());
  for (const CriticalLine& line : lines) {
    const std::size_t before = cells.size();
    for (std::size_t i = 0; i < before; ++i) {
      if (!crosses(line, cells[i])) continue;
      if (cells[i].size() == Cell::kMostCorners) {  // no room for another: across the middle first
        const Vec2 across = cells[i].longest();
        const Cell::Halves halves = cells[i].cut(across, across.dot(cells[i].centre()));
        cells[i] = halves.above;
        cells.push_back(halves.below);
        const std::size_t added = cells.size() - 1;
        for (const std::size_t k : {i, added}) {
          if (!crosses(line, cells[k])) continue;
          const Cell::Halves parts = cells[k].cut(line.normal, line.level);
          cells[k] = parts.above;
          cells.push_back(parts.below);
        }
        continue;
      }
      const Cell::Halves halves = cells[i].cut(line.normal, line.level);
      cells[i] = halves.above;
      cells.push_back(halves.below);
    }
  }
  std::erase_if(cells, [](const Cell& cell) { return cell.size() < 3; });
  return cells;
}

}  // namespace etendue
