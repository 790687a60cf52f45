// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "etendue/core/rounding.hpp"
#include "etendue/optics/colour_tables.hpp"

// What the eye sees of a surface, summed over wavelengths in extended precision: the CIE's rule of equal steps, written anew.
namespace etendue::validation {

using ByWavelength = std::function<long double(long double)>;  // of nm
using Triple = Eigen::Matrix<long double, 3, 1>;

/// From X, Y, Z to linear sRGB, by the chromaticities of its primaries and its white (ITU-R BT.709-6).
inline Eigen::Matrix<long double, 3, 3> srgb_matrix() {
  const auto xyz = [](long double x, long double y) { return Triple(x / y, 1, (1 - x - y) / y); };
  Eigen::Matrix<long double, 3, 3> primaries;
  primaries << xyz(0.64L, 0.33L), xyz(0.3L, 0.6L), xyz(0.15L, 0.06L);
  const Triple amounts = primaries.inverse() * xyz(0.3127L, 0.3290L);
  return (primaries * amounts.asDiagonal()).inverse();
}

struct DirectColour {
  Triple value, bound;  ///< of what doubles may be off
};

/// Every `stride`-th wavelength of the table from the middle of the first `stride` on, of an odd `stride` that divides 81:
///
///     C = M Σ ρ S (x̄, ȳ, z̄) / M Σ D65 (x̄, ȳ, z̄)  ·  Σ D65 ȳ / Σ S ȳ        the last factor over the whole table
///
/// Bound: a term of a sum has at most 16 roundings of its absolute parts |M| ρ S (x̄, ȳ, z̄), a sum 81 more; the last factor's
/// sums have no signs, 2 · 83. So 200 u for each of numerator, denominator and factor is enough.
inline DirectColour direct_colour(const ByWavelength& reflectance, const ByWavelength& power, std::size_t stride = 1) {
  const auto matrix = srgb_matrix();
  const auto wavelength = [](std::size_t i) { return 380 + 5 * static_cast<long double>(i); };
  const auto day = [](std::size_t i) { return static_cast<long double>(daylight_d65()[i]); };
  long double luminance = 0, daylight_luminance = 0;
  for (std::size_t i = kTableLength; i-- > 0;) {
    luminance += power(wavelength(i)) * kObserverTable[i][1];
    daylight_luminance += day(i) * kObserverTable[i][1];
  }
  Triple seen = Triple::Zero(), white = seen, seen_parts = seen, white_parts = seen;
  for (std::size_t i = stride / 2; i < kTableLength; i += stride) {
    const Triple eye(kObserverTable[i][0], kObserverTable[i][1], kObserverTable[i][2]);
    const long double reflected = reflectance(wavelength(i)) * power(wavelength(i));
    seen += reflected * (matrix * eye);
    white += day(i) * (matrix * eye);
    seen_parts += reflected * (matrix.cwiseAbs() * eye);
    white_parts += day(i) * (matrix.cwiseAbs() * eye);
  }
  const long double scale = daylight_luminance / luminance;
  DirectColour colour;
  for (int c = 0; c < 3; ++c) {
    colour.value[c] = scale * seen[c] / white[c];
    const long double seen_share = scale * seen_parts[c] / std::abs(white[c]);
    const long double white_share = std::abs(colour.value[c]) * white_parts[c] / std::abs(white[c]);
    colour.bound[c] = 200 * kUnitRoundoff * (seen_share + white_share + std::abs(colour.value[c]));
  }
  return colour;
}

/// Illuminant A by its definition (CIE S 014-2:2006), but for its scale.
inline long double incandescent_light(long double wavelength) {
  return std::pow(560 / wavelength, 5.0L) / std::expm1(1.435e7L / 2848 / wavelength);
}

/// Of the table, at its own wavelengths.
inline long double daylight_light(long double wavelength) {
  return daylight_d65()[static_cast<std::size_t>(std::lround((wavelength - 380) / 5))];
}

}  // namespace etendue::validation
