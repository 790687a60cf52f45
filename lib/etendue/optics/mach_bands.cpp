// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/mach_bands.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// e^-5 of a neighbour's weight is less than one grey level of 256 of the largest step.
constexpr double kReachesToTheEnd = 5;

}  // namespace

std::vector<double> perceived(std::span<const double> intensities, const Inhibition& eye) {
  require(std::isfinite(eye.strength) && eye.strength >= 0 && std::isfinite(eye.reach) && eye.reach > 0,
          "perceived: strength is not negative, reach positive");
  const std::size_t n = intensities.size();
  if (n == 0) return {};
  for (const double value : intensities) require(std::isfinite(value), "perceived: intensities are finite");
  const double r = std::exp(-1 / eye.reach), share = (1 - r) / (1 + r);
  // Σ_{j ≥ 0} r^j I_{k−j} and Σ_{j ≥ 0} r^j I_{k+j}, each by one multiplication a pixel.
  std::vector<double> result(n);
  double before = intensities.front() / (1 - r);
  for (std::size_t k = 0; k < n; ++k) result[k] = before = intensities[k] + r * before;
  double after = intensities.back() / (1 - r);
  for (std::size_t k = n; k-- > 0;) {
    after = intensities[k] + r * after;
    const double around = share * (result[k] + after - intensities[k]);
    result[k] = intensities[k] + eye.strength * (intensities[k] - around);
  }
  return result;
}

Jumps jumps(std::span<const double> intensities, const Inhibition& eye) {
  Jumps most;
  const std::vector<double> seen = perceived(intensities, eye);
  const auto margin = static_cast<std::size_t>(std::ceil(std::min(kReachesToTheEnd * eye.reach, 1e9)));
  for (std::size_t k = 0; k < intensities.size(); ++k) {
    if (k > 0) most.intensity = std::max(most.intensity, std::abs(intensities[k] - intensities[k - 1]));
    if (k > 0 && k + 1 < intensities.size()) {
      const double bend = intensities[k + 1] - 2 * intensities[k] + intensities[k - 1];
      most.slope = std::max(most.slope, std::abs(bend));
    }
    if (k >= margin && k + margin < intensities.size())
      most.perceived = std::max(most.perceived, std::abs(seen[k] - intensities[k]));
  }
  return most;
}

}  // namespace etendue
