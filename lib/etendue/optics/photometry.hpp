// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// What red, green and blue of equal radiant flux share of the light that an eye sees: Y of linear Rec. 709 (sRGB) primaries with
/// white D65. They sum to 1.
/// Source    ITU-R BT.709-6, item 3.2
inline constexpr double kLuminanceWeights[3] = {0.2126, 0.7152, 0.0722};

/// Luminous efficacy of white radiation of equal energy at all wavelengths that an eye sees [lm/W]: what a watt of each
/// channel is taken for, unless one says otherwise. The number is a convention.
/// Source    Ward 1994, The RADIANCE lighting simulation and rendering system: WHTEFFICACY
inline constexpr double kWhiteEfficacy = 179;

/// Luminous efficacy of monochromatic radiation of 540 THz, 555 nm: the largest there is [lm/W], exact by definition.
/// Source    BIPM 2019, The International System of Units, 9th edition, 2.3.1
inline constexpr double kPeakEfficacy = 683;

/// Illuminance of three channels of irradiance; by the same rule luminous exitance of three of radiosity.
///
///     E_v = K (0.2126 H_r + 0.7152 H_g + 0.0722 H_b)
///
/// Symbols   H irradiance [W/m²], K luminous efficacy [lm/W]
/// Returns   [lx]; [W/m²] of light as an eye weighs it where K is 1
/// Accuracy  7u of the sum of the magnitudes: proved, three products, two sums, one factor and the decimals of the weights
[[nodiscard]] inline double illuminance(const Eigen::Array3d& irradiance, double efficacy = kWhiteEfficacy) {
  return efficacy * (kLuminanceWeights[0] * irradiance(0) + kLuminanceWeights[1] * irradiance(1) +
                     kLuminanceWeights[2] * irradiance(2));
}

}  // namespace etendue
