// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "etendue/image/image.hpp"

namespace etendue {

/// How samples become pixels.                                                                      @eq IU.5.8.1
enum class FilterKind { box, tent, gaussian, mitchell };

/// A separable filter: a sample at (dx, dy) from a pixel's centre, in pixels, counts with weight f(dx) f(dy).
///
///     box         1                                            in [−r, r), zero elsewhere, as all are
///     tent        1 − |x|/r
///     gaussian    exp(−½ (x/σ)²) − exp(−½ (r/σ)²),  σ = r/3
///     mitchell    the cubic of Mitchell and Netravali with B = C = 1/3, stretched from its radius 2 to r
///
/// Symbols   r half the filter's width [pixels]
/// Returns   weights whose scale means nothing: filtered values are divided by their sum. Of box, tent and Mitchell with
///           their usual widths the weights of samples one pixel apart sum to one; Mitchell's are negative beyond r/2
/// Source    Mitchell and Netravali 1988, doi 10.1145/378456.378514
struct PixelFilter {
  FilterKind kind = FilterKind::box;
  double radius = 0.5;

  double weight(double x) const;
  /// How many pixels to each side a sample may count in, besides its own.
  int reach() const;
};

/// The usual width, 2 r: box 1, tent 2, Gaussian 3, Mitchell 4 pixels.
[[nodiscard]] PixelFilter usual_filter(FilterKind kind);

/// A value of the picture, at a place in it.
struct ImageSample {
  double x, y;    ///< in pixels from the picture's left and top edge
  double weight;  ///< > 0: the share of the picture that it stands for, in any unit
  Eigen::Array3d colour;
};

/// What the samples of one row of pixels add to that row and its neighbours.
///
/// The sums of a pixel are made in the order of the samples, row by row, so they do not depend on who computes which row.
class FilterRow {
 public:
  FilterRow() = default;
  /// Of picture row `row`, for the columns [first, last).
  FilterRow(const PixelFilter& filter, int row, int first, int last);

  /// Samples come in the order of their pixels' columns; the sample lies in this row and in pixel `column`.
  void add(int column, const ImageSample& sample);

  bool empty() const { return sums_.empty(); }

  /// The pixel of `column` in row `row` from all rows within reach, `rows` being in order of their rows:
  ///     Σ w f I / Σ w f
  [[nodiscard]] static Eigen::Array3d resolve(const std::vector<const FilterRow*>& rows, int column, int row);

 private:
  struct Sum {
    Eigen::Array3d colour = Eigen::Array3d::Zero();
    double weight = 0;
  };
  Sum& sum(int dy, int column) {
    return sums_[static_cast<std::size_t>(dy + reach_) * static_cast<std::size_t>(last_ - first_) +
                 static_cast<std::size_t>(column - first_)];
  }
  const Sum& sum(int dy, int column) const { return const_cast<FilterRow*>(this)->sum(dy, column); }

  PixelFilter filter_;
  int row_ = 0, first_ = 0, last_ = 0, reach_ = 0;
  std::vector<Sum> sums_;       ///< of the rows row − reach … row + reach
  std::vector<double> across_;  ///< weights of one sample, by column; kept to save allocations
};

}  // namespace etendue
