// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/corner_cells.hpp"

#include <algorithm>

#include "etendue/core/contract.hpp"

namespace etendue {

CornerCells::CornerCells(const Sampling& sampling, int row, ColumnSpan columns, const Points* above,
                         const Points* below, const Look& look)
    : sampling_(sampling),
      n_(sampling.samples_per_side),
      row_(row),
      columns_(columns),
      width_((columns.last - columns.first) * n_ + 1),
      look_(look),
      points_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(n_ + 1)),
      counted_(points_.size(), -1) {
  for (const Points* edge : {above, below}) {
    if (!edge) continue;
    require(edge->size() == static_cast<std::size_t>(width_), "CornerCells: the rows have the same columns");
    std::copy(edge->begin(), edge->end(),
              points_.begin() + static_cast<std::ptrdiff_t>(index(0, edge == above ? 0 : n_)));
  }
}

const Glimpse& CornerCells::at(int x, int y, PixelWork& work) {
  SampledRow::Point& point = points_[index(x, y)];
  if (!point.seen) {
    const int across = columns_.first * n_ + x, down = row_ * n_ + y;
    // The corner's own place on the picture's grid makes its numbers, whichever pixel asks.
    SampleKey key = sample_key(sampling_.seed, across, down, 0);
    // What it spreads, it spreads over the corners of the pixel to its lower right.
    key.pixel = sample_key(sampling_.seed, across / n_, down / n_, 0).pixel;
    key.index = down % n_ * n_ + across % n_;
    key.side = n_;
    point = {true, look_(static_cast<double>(across) / n_, static_cast<double>(down) / n_, key)};
  }
  if (counted_[index(x, y)] != column_) {
    counted_[index(x, y)] = column_;
    ++work.samples;
    work.tree_depth = std::max(work.tree_depth, point.value.tree_depth);
  }
  return point.value;
}

void CornerCells::divide(const Cell& cell, int column, FilterRow& light, PixelWork& work) {
  ColourRange range;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (const int y : {cell.y, cell.y + cell.size}) {
    for (const int x : {cell.x, cell.x + cell.size}) {
      const Eigen::Array3d& colour = at(x, y, work).colour;
      range.add(colour);
      sum += colour;
    }
  }
  if (cell.size > 1 && (range.contrast() > sampling_.threshold).any()) {
    const int half = cell.size / 2;
    for (const int y : {cell.y, cell.y + half}) {
      for (const int x : {cell.x, cell.x + half}) divide({x, y, half}, column, light, work);
    }
    return;
  }
  const double x = columns_.first + (cell.x + 0.5 * cell.size) / n_, y = row_ + (cell.y + 0.5 * cell.size) / n_;
  light.add(column, {x, y, static_cast<double>(cell.size * cell.size), sum / 4});
}

PixelWork CornerCells::pixel(int column, FilterRow& light) {
  PixelWork work;
  column_ = column;
  divide({(column - columns_.first) * n_, 0, n_}, column, light, work);
  return work;
}

CornerCells::Points CornerCells::edge(int line) const {
  const auto first = points_.begin() + static_cast<std::ptrdiff_t>(index(0, line));
  return Points(first, first + width_);
}

}  // namespace etendue
