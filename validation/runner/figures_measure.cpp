// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "etendue/core/contract.hpp"
#include "runner/figures.hpp"

namespace etendue::validation {

double fitted_slope(const Convergence& convergence) {
  const auto n = static_cast<double>(convergence.sizes.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < convergence.sizes.size(); ++i) {
    const double a = std::log10(convergence.sizes[i]), b = std::log10(convergence.errors[i]);
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  return n < 2 ? std::numeric_limits<double>::quiet_NaN() : (n * xy - x * y) / (n * xx - x * x);
}

double misfit(const Convergence& convergence) {
  const double slope = fitted_slope(convergence), n = static_cast<double>(convergence.sizes.size());
  std::vector<double> offsets;
  double mean = 0, worst = 0;
  for (std::size_t i = 0; i < convergence.sizes.size(); ++i) {
    offsets.push_back(std::log10(convergence.errors[i]) - slope * std::log10(convergence.sizes[i]));
    mean += offsets.back() / n;
  }
  for (const double offset : offsets) worst = std::max(worst, std::abs(offset - mean));
  return worst;
}

FactorDefects defects_of(const FactorTable& table) {
  const std::size_t n = table.areas.size();
  require(table.factors.size() == n * n && table.bounds.size() == n * n, "defects_of: n · n factors and bounds");
  FactorDefects found;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
      sum += table.factors[i * n + j];
      const double one = table.areas[i] * table.factors[i * n + j], other = table.areas[j] * table.factors[j * n + i];
      found.reciprocity = std::max(found.reciprocity, std::abs(one - other));
      found.widest = std::max(found.widest, table.bounds[i * n + j]);
    }
    const bool covered = std::find(table.covered.begin(), table.covered.end(), i) != table.covered.end();
    if (!covered) found.closure = std::max(found.closure, std::abs(1 - sum));
  }
  return found;
}

ImageErrors errors_of(const ImagePair& pair) {
  ImageErrors found;
  std::vector<double> of_pixels;
  for (std::size_t k = 0; k < pair.reference.size(); k += 3) {
    double worst = 0;
    for (std::size_t c = k; c < k + 3; ++c) {
      found.nan += std::isnan(pair.ours[c]) || std::isnan(pair.reference[c]) ? 1U : 0U;
      found.infinite += std::isinf(pair.ours[c]) || std::isinf(pair.reference[c]) ? 1U : 0U;
      const double difference = std::abs(static_cast<float>(pair.ours[c] - pair.reference[c]));
      if (std::isfinite(difference)) worst = std::max(worst, difference);
    }
    if (of_pixels.empty() || worst > found.worst) {
      const auto at = static_cast<int>(k / 3);
      found.column = at % pair.columns;
      found.row = at / pair.columns;
      found.worst = worst;
    }
    of_pixels.push_back(worst);
    found.mean += worst;
  }
  if (of_pixels.empty()) return found;
  found.mean /= static_cast<double>(of_pixels.size());
  std::sort(of_pixels.begin(), of_pixels.end());
  const auto percentile = [&](std::size_t p) { return of_pixels[(of_pixels.size() - 1) * p / 100]; };
  found.median = percentile(50);
  found.p95 = percentile(95);
  found.p99 = percentile(99);
  return found;
}

}  // namespace etendue::validation
