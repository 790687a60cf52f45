// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "etendue/image/filter.hpp"
#include "etendue/raytracing/sample_key.hpp"

namespace etendue {

/// Where in a pixel light is looked for. N samples a side tell apart what has fewer than N/2 periods a pixel, and show what
/// has more as something slower.                                          @eq IU.5.8, IU.5.8.1, IU.5.8.2, IU.f47
enum class SamplingScheme {
  uniform,            ///< the centres of N × N equal parts
  jittered,           ///< one random point in each of N × N equal parts
  adaptive,           ///< the corners; quartered while they differ, to N × N parts at most (N a power of two)
  adaptive_jittered,  ///< one of N × N jittered samples; the others too where it differs from those of the neighbours
};

/// Contrasts above which more samples are taken: red, green, blue of [IU] 5.8.2.
inline const Eigen::Array3d kContrastThresholds{0.25, 0.20, 0.40};

struct Sampling {
  SamplingScheme scheme = SamplingScheme::uniform;
  int samples_per_side = 1;  ///< N
  Eigen::Array3d threshold = kContrastThresholds;
  std::uint64_t seed = 0;
};

/// Parts of a side, at most; and of a side that is quartered, whose samples are held a row of pixels at a time.
inline constexpr int kMostSamplesPerSide = 64;
inline constexpr int kMostParts = 16;

/// What is wrong with it, if anything.
[[nodiscard]] std::optional<std::string> fault(const Sampling& sampling);

/// Smallest and largest value a channel has among some samples.
class ColourRange {
 public:
  void add(const Eigen::Array3d& colour);
  /// C = (I_max − I_min)/(I_max + I_min) of each channel, and 0 where both are 0 (G10).             @eq IU.5.8.2
  Eigen::Array3d contrast() const;

 private:
  bool empty_ = true;
  Eigen::Array3d low_ = Eigen::Array3d::Zero(), high_ = Eigen::Array3d::Zero();
};

/// What a sample sees, and how deep a tree of rays that took.
struct Glimpse {
  Eigen::Array3d colour = Eigen::Array3d::Zero();
  int tree_depth = 0;
};
/// Looks at a place of the picture, x and y in pixels from its left and top edge.
using Look = std::function<Glimpse(double x, double y, const SampleKey& key)>;

/// The work a pixel was.
struct PixelWork {
  int samples = 0;     ///< on which its value rests, but for what a filter takes from the neighbours
  int tree_depth = 0;  ///< greatest level of a ray that was followed for them
};

/// Columns [first, last) of a picture of so many columns and rows.
struct ColumnSpan {
  int first = 0, last = 0;
};

/// The samples of one row of pixels.
struct SampledRow {
  struct Point {
    bool seen = false;
    Glimpse value;
  };
  int row = 0;
  ColumnSpan columns;
  std::vector<Glimpse> first;      ///< adaptive_jittered: the first sample of each pixel
  std::vector<ImageSample> at;     ///< … and what it counts as, while the pixel has no other
  std::vector<Point> top, bottom;  ///< adaptive: what was seen along the row's edges, at the corners of its N × N parts
  FilterRow light;
  std::vector<PixelWork> work;  ///< by column, from columns.first
};

/// Takes the samples of a picture, row by row, in two steps; each place is looked at once.
///
/// First `begin` rows (of `adaptive`: the even ones, completely), in any order; then `complete` each row, when the rows above
/// and below have begun or do not exist. Rows of the same step may be computed at once by several threads.
/// A sample's numbers depend on seed, pixel and index alone: every part of a picture comes out as in the whole.
class RowSampler {
 public:
  /// `columns`, those that the picture shows, of `picture_columns`; domain: no fault(sampling)
  RowSampler(const Sampling& sampling, const PixelFilter& filter, ColumnSpan columns, int picture_columns);

  /// Whether the scheme takes something in the first step in this row.
  bool begins(int row) const;
  SampledRow begin(int row, const Look& look) const;
  /// `row` as begun, or a new one; `above` and `below` are null where they are not needed or do not exist.
  void complete(SampledRow& row, const SampledRow* above, const SampledRow* below, const Look& look) const;

  SampledRow fresh(int row) const;

 private:
  void take_all(SampledRow& row, const Look& look) const;
  void take_corners(SampledRow& row, const SampledRow* above, const SampledRow* below, const Look& look) const;
  void take_where_needed(SampledRow& row, const SampledRow* above, const SampledRow* below, const Look& look) const;

  Sampling sampling_;
  PixelFilter filter_;
  ColumnSpan shown_;   ///< columns of the picture that is made
  ColumnSpan needed_;  ///< columns whose samples count in these
  ColumnSpan looked_;  ///< columns that begin: needed_ and, where contrast is asked for, their neighbours
};

/// Positions of N samples across a pixel: the centres of N equal parts.                            @eq IU.5.8.1
[[nodiscard]] double sample_position(int index, int samples_per_side);

}  // namespace etendue
