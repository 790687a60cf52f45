// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/optics/colour.hpp"

namespace etendue {

/// A quantity by wavelength, linear between points.
struct Spectrum {
  struct Point {
    double wavelength;  ///< [nm]
    double value;
  };
  std::vector<Point> points;  ///< at least one; wavelengths ascend

  /// Beyond the points, that of the nearest.
  /// Accuracy  4 u of the larger of the two values beside it, where none is negative
  /// Errors    ContractViolation without points
  [[nodiscard]] double at(double wavelength) const;
};

/// The spectrum through values at the wavelengths of colour.hpp's tables.
/// Errors    ContractViolation on any other number of values than kTableLength
[[nodiscard]] Spectrum through_table(const std::vector<double>& values);

/// A light by its spectrum.
struct Illuminant {
  Spectrum power;    ///< as bright as daylight: Σ S ȳ over the table's wavelengths is that of D65
  LinearSrgb white;  ///< colour of a surface that reflects all of it; that of daylight is (1, 1, 1), to the bit
};

/// Whether the eye sees light of this spectrum: Y over the table's wavelengths is above 0, by enough to divide by it.
[[nodiscard]] bool is_visible(const Spectrum& power);

/// The light of a spectrum, whatever its scale.                                                  @eq IU.2.9b
///
///     white = M Σ S (x̄, ȳ, z̄) Δλ / M Σ D65 (x̄, ȳ, z̄) Δλ        per channel; M is linear_srgb()
///
/// The division puts white where sRGB has it; the chromaticity of the table's D65 is that of sRGB to 1e-4 only.
/// Domain    values not negative; is_visible()
/// Errors    ContractViolation outside the domain
[[nodiscard]] Illuminant illuminant(const Spectrum& power);

/// Linear sRGB of a surface by daylight D65: what three channels can know of its reflectance.   @eq IU.2.9, IU.2.9b
///
///     k_d = M Σ ρ D65 (x̄, ȳ, z̄) Δλ / M Σ D65 (x̄, ȳ, z̄) Δλ      per channel, over the table's wavelengths
///
/// Returns   grey of ρ for a constant ρ, to 4 kTableLength u; channels below 0 or above 1 where no screen shows the colour
[[nodiscard]] LinearSrgb colour_by_daylight(const Spectrum& reflectance);

/// The visible light in `count` parts of equal width, the middle of each.                         @eq IU.2.9b
///
/// The parts divide [380 − 2.5, 780 + 2.5] nm, so that 81 of them have the table's wavelengths: a sum over these is the
/// CIE's of 5 nm. A middle outside [380, 780] stands for the nearer end.
/// Domain    count ≥ 1
/// Returns   wavelengths in ascending order; weights as wavelength_samples(): they sum to 1 in each channel
/// Errors    ContractViolation outside the domain
[[nodiscard]] std::vector<WavelengthSample> even_wavelengths(int count);

/// The same wavelengths under a light: weights w S(λ), in each channel divided by Σ w D65(λ).        @eq IU.2.9b
///
/// Returns   weights that sum to 1 in each channel where the light is daylight, and, where the samples are the table's, to
///           `white` of any other
[[nodiscard]] std::vector<WavelengthSample> lit(std::vector<WavelengthSample> samples, const Illuminant& light);

}  // namespace etendue
