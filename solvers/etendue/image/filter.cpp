// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/filter.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

constexpr double kSigmas = 3;  // of the Gaussian, within its radius

double mitchell(double x) {
  constexpr double b = 1.0 / 3, c = 1.0 / 3;
  const double square = x * x, cube = square * x;
  if (x < 1) return ((12 - 9 * b - 6 * c) * cube + (-18 + 12 * b + 6 * c) * square + (6 - 2 * b)) / 6;
  return ((-b - 6 * c) * cube + (6 * b + 30 * c) * square + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

}  // namespace

double PixelFilter::weight(double x) const {
  if (x < -radius || x >= radius) return 0;
  const double share = std::abs(x) / radius;
  switch (kind) {
    case FilterKind::box:
      return 1;
    case FilterKind::tent:
      return 1 - share;
    case FilterKind::gaussian:
      return std::exp(-0.5 * kSigmas * kSigmas * share * share) - std::exp(-0.5 * kSigmas * kSigmas);
    case FilterKind::mitchell:
      return mitchell(2 * share);
  }
  return 0;
}

int PixelFilter::reach() const {
  return static_cast<int>(std::ceil(std::max(0.0, radius - 0.5)));
}

PixelFilter usual_filter(FilterKind kind) {
  switch (kind) {
    case FilterKind::box:
      return {kind, 0.5};
    case FilterKind::tent:
      return {kind, 1};
    case FilterKind::gaussian:
      return {kind, 1.5};
    case FilterKind::mitchell:
      return {kind, 2};
  }
  return {};
}

FilterRow::FilterRow(const PixelFilter& filter, int row, int first, int last)
    : filter_(filter), row_(row), first_(first), last_(last), reach_(filter.reach()) {
  require(filter.radius > 0 && first < last, "FilterRow: a radius and a column");
  sums_.resize(static_cast<std::size_t>(2 * reach_ + 1) * static_cast<std::size_t>(last - first));
  across_.resize(static_cast<std::size_t>(2 * reach_ + 1));
}

void FilterRow::add(int column, const ImageSample& sample) {
  const int low = std::max(first_, column - reach_), high = std::min(last_ - 1, column + reach_);
  for (int c = low; c <= high; ++c) {
    across_[static_cast<std::size_t>(c - low)] = filter_.weight(sample.x - (c + 0.5));
  }
  for (int dy = -reach_; dy <= reach_; ++dy) {
    const double down = sample.weight * filter_.weight(sample.y - (row_ + dy + 0.5));
    if (down == 0) continue;
    for (int c = low; c <= high; ++c) {
      const double weight = down * across_[static_cast<std::size_t>(c - low)];
      Sum& to = sum(dy, c);
      to.colour += weight * sample.colour;
      to.weight += weight;
    }
  }
}

Eigen::Array3d FilterRow::resolve(const std::vector<const FilterRow*>& rows, int column, int row) {
  Sum total;
  for (const FilterRow* from : rows) {
    const Sum& part = from->sum(row - from->row_, column);
    total.colour += part.colour;
    total.weight += part.weight;
  }
  // Jittered samples may all lie where Mitchell's weights cancel, or outside a narrow filter: then the pixel is black.
  if (!(total.weight > 0)) return Eigen::Array3d::Zero();
  return total.colour / total.weight;
}

}  // namespace etendue
