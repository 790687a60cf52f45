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

/// The same for a conductor, whose index is complex: what is not reflected is absorbed.               @eq IU.4.2.2F
///
///     F = ½ (R_s + R_p),   R_s = ((a − c)² + b²) / ((a + c)² + b²),   R_p = R_s ((ac − s²)² + b²c²) / ((ac + s²)² + b²c²)
///     (a + ib)² = (η + ik)² − s²
///
/// Symbols   c = cos θ, s = sin θ; η + ik index of the conductor over that of the (transparent) side of incidence
/// Domain    cosine in [0, 1]; eta in [kLeastIndexRatio, kGreatestIndexRatio]; k in [0, kGreatestIndexRatio]
/// Returns   value in [0, 1]; ((η−1)² + k²) / ((η+1)² + k²) at normal, 1 at grazing incidence; for k = 0
///           fresnel_reflectance(cosine, 1/eta)
/// Accuracy  absolute kConductorError, measured; nothing of the form 0/0 at any angle
/// Errors    ContractViolation outside the domain
/// Source    Born and Wolf, Principles of Optics, §14.2
inline constexpr double kConductorError = 32 * kUnitRoundoff;
[[nodiscard]] double fresnel_conductor(double cosine, double eta, double k);

/// Schlick's approximation of either: F_0 + (1 − F_0)(1 − cos θ)⁵.
///
/// Symbols   F_0 reflectance at normal incidence
/// Domain    cosine and normal in [0, 1]
/// Accuracy  of the formula: within kSchlickError of fresnel_reflectance() for dielectrics of η from 1.4 to 2, entered from
///           outside, worst near 85°; 0.06 for water, 0.08 for diamond; measured. Inside a dielectric it knows nothing of
///           total internal reflection
/// Errors    ContractViolation outside the domain
/// Source    Schlick 1994
inline constexpr double kSchlickError = 0.05;
[[nodiscard]] double schlick(double cosine, double normal);

}  // namespace etendue
