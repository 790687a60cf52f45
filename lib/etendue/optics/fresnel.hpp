// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/rounding.hpp"
#include "etendue/optics/refract.hpp"

namespace etendue {

/// Bound on the relative error of fresnel_reflectance(). Without the cosine of refraction: at any angle. NOTES.md §4.
constexpr double fresnel_relative_error(double eta, double refracted_cosine = 0) {
  return (eta <= 1 || refracted_cosine >= kSteepCosine ? 30 : 34 + 6 * eta * eta) * kUnitRoundoff;
}

/// Fraction of unpolarised light that a smooth boundary between two dielectrics reflects.
///
///     F = ½ [sin²(φ−θ)/sin²(φ+θ) + tan²(φ−θ)/tan²(φ+θ)]                                      @eq IU.4.2.2F
///
/// Symbols   θ angle of incidence, φ angle of refraction (sin φ = η sin θ; not the angle of view, E6);
///           η = η_incident / η_transmitted
/// Domain    cosine = |cos θ| in [0, 1]; eta in [kLeastIndexRatio, kGreatestIndexRatio]
/// Returns   value in [0, 1]; ((η−1)/(η+1))² at normal incidence, where the formula is 0/0; 1 at grazing incidence
///           and on total internal reflection; 0 for η = 1 at any angle
/// Accuracy  fresnel_relative_error(eta), proved
/// Errors    ContractViolation outside the domain
[[nodiscard]] double fresnel_reflectance(double cosine, double eta);

}  // namespace etendue
