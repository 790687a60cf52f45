// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Share of the light that is left behind a stretch of an absorbing medium (Bouguer, Lambert, Beer), per channel.
///
///     T = exp(−σ d)
///
/// Symbols   σ absorption coefficient [1/length], d length of the stretch [length]
/// Domain    σ ≥ 0, d ≥ 0; d may be infinite
/// Returns   value in [0, 1]; exactly 1 where σ = 0, at any distance, and 0 behind an infinite stretch where σ > 0
/// Accuracy  relative (1 + σ d) u and what std::exp adds (1 ulp in glibc): one rounding of the product, proved
/// Source    Beer 1852
[[nodiscard]] inline Eigen::Array3d transmittance(const Eigen::Array3d& absorption, double distance) {
  Eigen::Array3d left = Eigen::Array3d::Ones();
  for (int channel = 0; channel < 3; ++channel) {
    if (absorption[channel] > 0) left[channel] = std::exp(-absorption[channel] * distance);
  }
  return left;
}

}  // namespace etendue
