// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/vector.hpp"
#include "etendue/optics/reflect.hpp"

namespace etendue {

/// Bound on the absolute error of phong(): n times that of R·V, and one ulp for the power. NOTES.md of this folder, §1.
constexpr double phong_error(double exponent) {
  return exponent * (reflection_error() + 4 * kUnitRoundoff) + 2 * kUnitRoundoff;
}

/// Phong's lobe: how much of the directed reflection goes towards the viewer.
///
///     cosⁿ φ = max(0, R·V)ⁿ,   R = 2 N (N·L) − L                          @eq IU.2.7, IU.2.7.1, IU.2-6, IU.2-7
///
/// Symbols   N unit normal on the viewed side; L, V unit vectors towards the light and the viewer; φ angle between V
///           and R, the mirror direction of this light (one for each light: E3); n from 1 (dull) to 200 (glossy), a
///           mirror for n → ∞
/// Domain    unit vectors (kUnitTolerance); exponent ≥ 1, finite
/// Returns   value in [0, 1], greatest at V = R. 0 for a light behind the surface, and 0 for φ ≥ 90°, where an even
///           power of the negative cosine would shine (G2)
/// Accuracy  phong_error(exponent), proved for a pow that errs by less than one ulp
/// Errors    ContractViolation outside the domain
[[nodiscard]] double phong(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer, double exponent);

/// The lobe with a coefficient that depends on the angle of incidence: W(θ) cosⁿ φ.                        @eq IU.2.7.1
/// Symbols   weight(c) is W at c = cos θ = N·L in [0, 1]: a constant k_s, or Fresnel's factor, or what was measured
/// Returns   0 where phong() is; there the weight is not asked
/// Accuracy  of phong() and of the weight
/// Errors    as phong()
[[nodiscard]] double weighted_phong(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer, double exponent,
                                    const std::function<double(double)>& weight);

constexpr double blinn_error(double exponent) {
  return (8 * exponent + 2) * kUnitRoundoff;
}

/// Blinn's form of the lobe: the power of the cosine between the normal and the direction halfway.
///
///     max(0, N·H)ⁿ,   H = (L + V)/|L + V|                                                              @eq IU.2.7.1
///
/// Symbols   as for phong(). In the plane of N and L the angle between N and H is half of φ, so that blinn() with 4n
///           is near to phong() with n where the lobe is narrow; out of that plane it is narrower, the more so the more
///           the light grazes
/// Domain    unit vectors (kUnitTolerance); exponent ≥ 1, finite
/// Returns   value in [0, 1], greatest at V = R; 0 for a light or a viewer behind the surface
/// Accuracy  blinn_error(exponent) of the given vectors; measured
/// Errors    ContractViolation outside the domain
/// Source    Blinn 1977
[[nodiscard]] double blinn(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer, double exponent);

}  // namespace etendue
