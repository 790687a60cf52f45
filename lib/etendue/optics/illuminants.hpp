// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Planck's law: spectral radiance of a black body [W/(m² sr) per m].                            @eq IU.2.1
///
///     L = 2hc²/λ⁵ / (exp(hc/λkT) − 1)
///
/// Symbols   h, c, k exact by the definition of the SI; λ wavelength [nm], T temperature [K]
/// Domain    both positive and finite
/// Accuracy  relative 2^-50 + 2^-52 hc/λkT: the exponent's rounding, magnified; measured
/// Errors    ContractViolation outside the domain
/// Source    BIPM, The International System of Units, 9th edition, 2019 (the constants)
[[nodiscard]] double black_body(double wavelength_nm, double temperature);

/// The sun's surface radiates as much as a black body of this temperature [K].
/// Source    IAU 2015 Resolution B3, nominal effective temperature
inline constexpr double kSunTemperature = 5772;

/// Relative power of incandescent light, illuminant A, at the wavelengths of colour.hpp's tables; 100 at 560 nm.      @eq IU.2.1
///
///     S = 100 (560/λ)⁵ (exp(1.435e7/(2848 · 560)) − 1)/(exp(1.435e7/2848 λ) − 1)
///
/// Accuracy  relative 2^-48; proved by the formula's few roundings
/// Source    CIE S 014-2:2006, Illuminants, which defines A by this formula, with its constants
[[nodiscard]] const std::vector<double>& incandescent_a();

/// Phong's model at each wavelength, without attenuation.                                          @eq IU.2.9b
///
///     I_λ = k_dλ I_aλ + I_pλ [k_dλ (N·L) + k_s (R·V)ⁿ]
///
/// Symbols   diffuse k_dλ; ambient I_aλ; light I_pλ; incidence N·L and directed k_s (R·V)ⁿ, both not negative
/// Domain    spectra of one length
/// Errors    ContractViolation for different lengths, or a negative incidence or directed part
[[nodiscard]] std::vector<double> reflected_spectrum(const std::vector<double>& diffuse,
                                                     const std::vector<double>& ambient,
                                                     const std::vector<double>& light, double incidence,
                                                     double directed);

}  // namespace etendue
