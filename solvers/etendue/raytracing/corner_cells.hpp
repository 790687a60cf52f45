// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/raytracing/sampling.hpp"

namespace etendue {

/// The pixels of one row as cells with a sample in each corner, quartered where these differ.      @eq IU.5.8.2, IU.f48
///
/// All corners lie on a grid of N + 1 lines by N a pixel. What was seen at one is kept: for the cell beside it, for its
/// quarters, and, along the row's edges, for the rows above and below.
class CornerCells {
 public:
  using Points = std::vector<SampledRow::Point>;

  /// `above`, `below`: what the neighbours saw along the edges that they share with this row; null: nothing yet.
  CornerCells(const Sampling& sampling, int row, ColumnSpan columns, const Points* above, const Points* below,
              const Look& look);

  /// Quarters the pixel as far as needed and adds its parts to `light`: each as a sample in its centre, with the mean of its
  /// corners, weighed by its area.
  PixelWork pixel(int column, FilterRow& light);

  /// What is known along a line of the grid: 0 the row's upper edge, N its lower one.
  Points edge(int line) const;

 private:
  struct Cell {
    int x, y, size;  ///< upper left corner on the grid, length of an edge
  };
  const Glimpse& at(int x, int y, PixelWork& work);
  void divide(const Cell& cell, int column, FilterRow& light, PixelWork& work);
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  const Sampling& sampling_;
  const int n_, row_;
  const ColumnSpan columns_;
  const int width_;  ///< corners along the row
  const Look& look_;
  Points points_;
  std::vector<int> counted_;  ///< the pixel that last counted this corner among its own
  int column_ = 0;
};

}  // namespace etendue
