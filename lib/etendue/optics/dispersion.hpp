// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <variant>
#include <vector>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// The light that eyes see, and that the formulas below are asked for: wavelengths in vacuum or air, which differ by less
/// than 0.2 nm [nm].
inline constexpr double kShortestVisible = 380;
inline constexpr double kLongestVisible = 780;

/// Fraunhofer's lines that glass catalogues use [nm]: yellow of helium, blue and red of hydrogen.
/// Source    Schott, Technical Information TIE-29
inline constexpr double kLineD = 587.5618;
inline constexpr double kLineF = 486.1327;
inline constexpr double kLineC = 656.2725;

/// Cauchy's formula: n = a + b/λ² + c/λ⁴.                                                       @eq IU.4-6
/// Symbols   λ wavelength [µm]; a [1], b [µm²], c [µm⁴]
struct Cauchy {
  double a = 1;
  double b = 0;
  double c = 0;
};

/// Sellmeier's formula: n² = 1 + Σ B_i λ² / (λ² − C_i).                                           @eq IU.4-6
/// Symbols   λ wavelength [µm]; B_i strength of a resonance [1], C_i square of its wavelength [µm²]
struct Sellmeier {
  std::array<double, 4> strength{};
  std::array<double, 4> resonance{};
};

/// How a refractive index depends on the wavelength.
using Dispersion = std::variant<Cauchy, Sellmeier>;

/// Refractive index at a wavelength [nm].
/// Domain    a visible wavelength, for which the formula gives a positive, finite index (has_index())
/// Accuracy  8 u of the formula for Cauchy's with positive coefficients; for Sellmeier's, u times 4 + Σ B_i (6 + λ²/|λ² − C_i|)
///           λ²/|λ² − C_i| / n²: proved, count of the roundings. The formula itself keeps to 1e-5 of the catalogue's glasses
/// Errors    ContractViolation: the wavelength is not visible
[[nodiscard]] double refractive_index(const Dispersion& dispersion, double wavelength_nm);

/// Whether the formula gives an index in [least, greatest] at every whole nanometre that is visible.
[[nodiscard]] bool has_index(const Dispersion& dispersion, double least, double greatest);

/// Abbe's number: (n_d − 1)/(n_F − n_C). Infinite where there is no dispersion.
[[nodiscard]] double abbe_number(const Dispersion& dispersion);

/// A medium whose dispersion is published.
struct KnownMedium {
  std::string_view name;
  Dispersion dispersion;
  std::string_view source;
};

/// N-BK7, N-SF11, SF11, F2 (Schott), fused silica, water at 20 °C, in the order of their indices for yellow.
[[nodiscard]] const std::vector<KnownMedium>& known_media();

/// The medium of that name, or nothing.
[[nodiscard]] const KnownMedium* find_medium(std::string_view name);

}  // namespace etendue
