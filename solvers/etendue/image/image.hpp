// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace etendue {

/// Linear RGB pixels, row 0 at the top, column 0 at the left.
struct Image {
  int columns = 0;
  int rows = 0;
  std::vector<Eigen::Array3d> pixels;  ///< rows · columns, row by row

  Image() = default;
  Image(int columns_, int rows_)
      : columns(columns_),
        rows(rows_),
        pixels(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), Eigen::Array3d::Zero()) {}

  Eigen::Array3d& at(int column, int row) { return pixels[index(column, row)]; }
  const Eigen::Array3d& at(int column, int row) const { return pixels[index(column, row)]; }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

}  // namespace etendue
