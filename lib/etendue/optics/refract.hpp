// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Ratios of refractive indices that refract() and fresnel_reflectance() take: no pair of media leaves this range, and
/// the proofs use it.
inline constexpr double kLeastIndexRatio = 0x1p-10;
inline constexpr double kGreatestIndexRatio = 0x1p10;

/// Bound on the error of the radicand 1 − η² sin²θ. The decision "total internal reflection" is exact wherever the true
/// value is farther from zero than this: never wrong for η ≤ 1, and for η > 1 only within 1e-30 of the critical
/// angle. The side from which the light comes is decided exactly where |δ·s| > 7 u². NOTES.md §3.
constexpr double refraction_decision_error(double eta) {
  return eta <= 1 ? 0 : 45 * (eta * eta) * (kUnitRoundoff * kUnitRoundoff);
}

/// Next to the critical angle, where the cosine of refraction is smaller than this, the bounds are wider.
inline constexpr double kSteepCosine = 0x1p-16;

/// Bound on the error of the cosine of refraction. Without the cosine itself: at any angle. NOTES.md §3.
constexpr double refraction_cosine_error(double eta, double refracted_cosine = 0) {
  return (eta <= 1 || refracted_cosine >= kSteepCosine ? 3 : 7 * eta) * kUnitRoundoff;
}

/// Bound on |computed − true| of refract(), as a distance between vectors; hence also on how far its length is from 1.
/// Without the cosine of refraction: at any angle. NOTES.md §3.
constexpr double refraction_error(double eta, double refracted_cosine = 0) {
  return (eta <= 1 || refracted_cosine >= kSteepCosine ? 12.5 : 11 + 7 * eta) * kUnitRoundoff;
}

/// Direction of the ray behind a boundary between two media, or nothing on total internal reflection.
///
///     S' = η S,   T = η [N (N·V) − V] − N sqrt(1 − η² [1 − (N·V)²])                      @eq IU.5-6, IU.5-7, IU.4-6
///     ϱ = η δ − [sqrt(1 − η² (1 − (δ·s)²)) + η (δ·s)] s,   s on the side of incidence                  @eq RT.18
///
/// So a slab sends the ray on parallel to itself, and 30° from air into glass bend by 10.53°.    @eq IU.4.3a, IU.4.3b
///
/// Symbols   δ = −V incident direction, travelling towards the surface; s = N unit normal;
///           η = η_incident / η_transmitted
/// Domain    unit vectors (kUnitTolerance); the normal may be on either side: only its line is used, and the ray
///           crosses to the side that it was not on, so that it may leave a solid with the outward normal (E11, R1).
///           eta is the ratio in the direction of travel, whatever the side of the normal. δ·s = 0 counts as
///           incidence from the side of s
/// Returns   unit vector for the exact directions of the two given vectors: lengths that are not exactly one are
///           divided out. At the critical angle itself: the tangent. nullopt exactly when the sine of refraction
///           would exceed one, up to refraction_decision_error(eta)                            @eq IU.5.3tir
/// Accuracy  refraction_error(eta), refraction_cosine_error(eta): proved. Not normalised again: no need
/// Errors    ContractViolation: not unit vectors, or eta outside [kLeastIndexRatio, kGreatestIndexRatio]
[[nodiscard]] std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal, double eta);

/// The cosine of the angle of refraction alone, in [0, 1]: the root in IU.5-7. Domain and errors of refract().
/// Accuracy  refraction_cosine_error(eta), proved
[[nodiscard]] std::optional<double> refracted_cosine(const Vec3& direction, const Vec3& normal, double eta);

}  // namespace etendue
