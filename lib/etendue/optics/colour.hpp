// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// CIE 1931 tristimulus values X, Y, Z.
using Xyz = Eigen::Array3d;
/// Linear red, green, blue of sRGB (Rec. 709 primaries, white D65); not cut off, so that spectral colours, which no screen
/// shows, have negative parts.
using LinearSrgb = Eigen::Array3d;

/// The wavelengths at which spectra are tabulated: 380, 385 … 780 nm.
inline constexpr double kTableStep = 5;
inline constexpr std::size_t kTableLength = 81;

/// x̄, ȳ, z̄ of the CIE 1931 standard observer (2°) at a wavelength [nm]: the table of 5 nm, linear between its entries, 0 outside.
///                                                                                            @eq IU.2.9b
/// Source    CIE 15:2004, Colorimetry, table T.4
[[nodiscard]] Xyz observer(double wavelength_nm);

/// Relative power of daylight, illuminant D65, at the table's wavelengths; 100 at 560 nm.
/// Source    CIE 15:2004, table T.1
[[nodiscard]] const std::vector<double>& daylight_d65();

/// Tristimulus values of a spectrum: Σ S(λ) x̄(λ) Δλ over the table's wavelengths, likewise Y and Z.      @eq IU.2.9b
/// Domain    kTableLength values
/// Errors    ContractViolation on any other number of values
[[nodiscard]] Xyz tristimulus(const std::vector<double>& spectrum);

/// Chromaticity x, y: X and Y as shares of X + Y + Z.
[[nodiscard]] Eigen::Array2d chromaticity(const Xyz& xyz);

/// From X, Y, Z to linear sRGB and back. White of Y = 1, chromaticity (0.3127, 0.3290), is (1, 1, 1).      @eq IU.2.9b
/// Accuracy  matrices to half an ulp: from the standard's chromaticities in rational numbers
/// Source    ITU-R BT.709-6; IEC 61966-2-1
[[nodiscard]] LinearSrgb linear_srgb(const Xyz& xyz);
[[nodiscard]] Xyz xyz_of(const LinearSrgb& colour);

/// A wavelength that stands for a part of the visible light, and what it counts in each channel.
struct WavelengthSample {
  double wavelength;  ///< [nm]
  LinearSrgb weight;  ///< negative where the spectral colour is one that no screen shows
};

/// The visible light in `count` parts, a wavelength from each.                                  @eq IU.2.9b, IU.4-6
///
/// The parts are of equal ∫ (x̄ + ȳ + z̄) dλ. From each the wavelength is taken that leaves the share `offset` of its own
/// integral behind; its weight is the colour of the whole part, per channel divided by that of all light. So equal energy
/// at all wavelengths is white, and grey stays grey, however few the parts are.
///
/// Domain    count ≥ 1, offset in [0, 1]; different offsets for different rays of a pixel blur the parts' borders
/// Returns   wavelengths in ascending order; weights that sum to 1 in each channel, to 4 count u
/// Errors    ContractViolation outside the domain
[[nodiscard]] std::vector<WavelengthSample> wavelength_samples(int count, double offset = 0.5);

}  // namespace etendue
