// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/raytracing/corner_cells.hpp"

namespace etendue {

namespace {

/// Place `share` of pixel `index`; rounding must not carry it into the next one.
double within_pixel(int index, double share) {
  return std::min(index + share, std::nextafter(index + 1.0, index));
}

/// Sample `index` of the N × N of a pixel: its place, its key.
struct Place {
  double x, y;
  SampleKey key;
};

Place place(const Sampling& sampling, int column, int row, int index) {
  const int n = sampling.samples_per_side;
  const SampleKey key = sample_key(sampling.seed, column, row, index, n);
  if (sampling.scheme == SamplingScheme::uniform)
    return {column + sample_position(index % n, n), row + sample_position(index / n, n), key};
  const double across = (index % n + key.number(sample_number::kAcross)) / n;
  const double down = (index / n + key.number(sample_number::kDown)) / n;
  return {within_pixel(column, across), within_pixel(row, down), key};
}

/// The sample of a pixel that adaptive_jittered takes first: any with the same probability, so that what is seen first is
/// not always to one side of the centre.
int first_index(const Sampling& sampling, int column, int row) {
  const int count = sampling.samples_per_side * sampling.samples_per_side;
  const double number = sample_key(sampling.seed, column, row, 0).number(sample_number::kStratum);
  return std::min(static_cast<int>(number * count), count - 1);
}

void note(PixelWork& work, const Glimpse& seen) {
  ++work.samples;
  work.tree_depth = std::max(work.tree_depth, seen.tree_depth);
}

bool is_power_of_two(int n) {
  return n > 0 && (n & (n - 1)) == 0;
}

}  // namespace

std::optional<std::string> fault(const Sampling& sampling) {
  const int n = sampling.samples_per_side;
  const std::string side = std::to_string(n) + (n == 1 ? " sample" : " samples") + " a side";
  if (n < 1) return side + " is less than one";
  if (n > kMostSamplesPerSide) return side + " is more than " + std::to_string(kMostSamplesPerSide);
  if (sampling.scheme == SamplingScheme::adaptive && !(is_power_of_two(n) && n <= kMostParts))
    return side + " is not 1, 2, 4, 8 or 16, as adaptive sampling wants, which quarters pixels";
  if (!(sampling.threshold >= 0).all()) return "a threshold of contrast is not 0 or more";
  return std::nullopt;
}

void ColourRange::add(const Eigen::Array3d& colour) {
  low_ = empty_ ? colour : Eigen::Array3d(low_.min(colour));
  high_ = empty_ ? colour : Eigen::Array3d(high_.max(colour));
  empty_ = false;
}

Eigen::Array3d ColourRange::contrast() const {
  Eigen::Array3d contrast;
  for (int channel = 0; channel < 3; ++channel) {
    const double sum = high_[channel] + low_[channel];
    contrast[channel] = sum > 0 ? (high_[channel] - low_[channel]) / sum : 0;
  }
  return contrast;
}

double sample_position(int index, int samples_per_side) {
  return (index + 0.5) / samples_per_side;
}

RowSampler::RowSampler(const Sampling& sampling, const PixelFilter& filter, ColumnSpan columns, int picture_columns)
    : sampling_(sampling), filter_(filter), shown_(columns) {
  require(!fault(sampling), "RowSampler: the sampling has no fault");
  require(columns.first >= 0 && columns.first < columns.last && columns.last <= picture_columns,
          "RowSampler: the columns lie in the picture");
  const auto widened = [&](const ColumnSpan& span, int by) {
    return ColumnSpan{std::max(span.first - by, 0), std::min(span.last + by, picture_columns)};
  };
  needed_ = widened(shown_, filter.reach());
  looked_ = widened(needed_, sampling.scheme == SamplingScheme::adaptive_jittered ? 1 : 0);
}

SampledRow RowSampler::fresh(int row) const {
  SampledRow fresh;
  fresh.row = row;
  fresh.columns = looked_;
  fresh.light = FilterRow(filter_, row, shown_.first, shown_.last);
  fresh.work.resize(static_cast<std::size_t>(looked_.last - looked_.first));
  return fresh;
}

bool RowSampler::begins(int row) const {
  if (sampling_.scheme == SamplingScheme::adaptive) return row % 2 == 0;
  return sampling_.scheme == SamplingScheme::adaptive_jittered;
}

SampledRow RowSampler::begin(int row, const Look& look) const {
  SampledRow begun = fresh(row);
  if (sampling_.scheme == SamplingScheme::adaptive && begins(row)) take_corners(begun, nullptr, nullptr, look);
  if (sampling_.scheme != SamplingScheme::adaptive_jittered) return begun;
  for (int column = looked_.first; column < looked_.last; ++column) {
    const Place at = place(sampling_, column, row, first_index(sampling_, column, row));
    begun.first.push_back(look(at.x, at.y, at.key));
    // It stands for the whole pixel, as all N × N would.
    const double whole = sampling_.samples_per_side * sampling_.samples_per_side;
    begun.at.push_back({at.x, at.y, whole, begun.first.back().colour});
  }
  return begun;
}

void RowSampler::complete(SampledRow& row, const SampledRow* above, const SampledRow* below, const Look& look) const {
  switch (sampling_.scheme) {
    case SamplingScheme::uniform:
    case SamplingScheme::jittered:
      take_all(row, look);
      break;
    case SamplingScheme::adaptive:
      if (!begins(row.row)) take_corners(row, above, below, look);
      break;
    case SamplingScheme::adaptive_jittered:
      take_where_needed(row, above, below, look);
      break;
  }
}

void RowSampler::take_all(SampledRow& row, const Look& look) const {
  const int count = sampling_.samples_per_side * sampling_.samples_per_side;
  for (int column = needed_.first; column < needed_.last; ++column) {
    for (int index = 0; index < count; ++index) {
      const Place at = place(sampling_, column, row.row, index);
      const Glimpse seen = look(at.x, at.y, at.key);
      row.light.add(column, {at.x, at.y, 1, seen.colour});
      note(row.work[static_cast<std::size_t>(column - looked_.first)], seen);
    }
  }
}

void RowSampler::take_where_needed(SampledRow& row, const SampledRow* above, const SampledRow* below,
                                   const Look& look) const {
  const int count = sampling_.samples_per_side * sampling_.samples_per_side;
  for (int column = needed_.first; column < needed_.last; ++column) {
    ColourRange range;
    for (const SampledRow* near : {above, static_cast<const SampledRow*>(&row), below}) {
      if (!near) continue;
      for (int c = std::max(column - 1, looked_.first); c <= std::min(column + 1, looked_.last - 1); ++c)
        range.add(near->first[static_cast<std::size_t>(c - looked_.first)].colour);
    }
    const auto i = static_cast<std::size_t>(column - looked_.first);
    if (count == 1 || !(range.contrast() > sampling_.threshold).any()) {
      row.light.add(column, row.at[i]);
      note(row.work[i], row.first[i]);
      continue;
    }
    const int taken = first_index(sampling_, column, row.row);
    for (int index = 0; index < count; ++index) {
      const Place at = place(sampling_, column, row.row, index);
      const Glimpse seen = index == taken ? row.first[i] : look(at.x, at.y, at.key);
      row.light.add(column, {at.x, at.y, 1, seen.colour});
      note(row.work[i], seen);
    }
  }
}

void RowSampler::take_corners(SampledRow& row, const SampledRow* above, const SampledRow* below,
                              const Look& look) const {
  CornerCells cells(sampling_, row.row, needed_, above ? &above->bottom : nullptr, below ? &below->top : nullptr, look);
  for (int column = needed_.first; column < needed_.last; ++column)
    row.work[static_cast<std::size_t>(column - looked_.first)] = cells.pixel(column, row.light);
  row.top = cells.edge(0);
  row.bottom = cells.edge(sampling_.samples_per_side);
}

}  // namespace etendue
