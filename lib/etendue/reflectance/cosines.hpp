// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/reflectance/local.hpp"

namespace etendue {

/// The two scalar products of a light that the local model rests on, unlimited: what dot-product interpolation carries from
/// the corners of a polygon into it.
struct LightCosines {
  double incidence = 0;  ///< N·L
  double mirror = 0;     ///< R·V, R = 2N(N·L) − L
};

/// Domain    unit vectors (kUnitTolerance)
/// Accuracy  each to a few roundings
/// Errors    ContractViolation outside the domain
[[nodiscard]] LightCosines light_cosines(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer);

/// local_reflection() from scalar products instead of vectors.                                       @eq IU.3.4, E30
///
///     I = k_a I_a + Σ_i I_p,i [k_d max(0, N·L_i) + k_s max(0, R_i·V)ⁿ],   no second term where N·L_i ≤ 0
///
/// Interpolated products may be anything in [−1, 1]: they are limited here, after the interpolation, and the power is
/// taken here. The text interpolates the power, (R·V)ⁿ; then everything is a sum of interpolated numbers, and the
/// picture is Gouraud's (E30).
/// Domain    as many lights' cosines as intensities; exponent finite, ≥ 1
/// Returns   red, green, blue; not limited above
/// Accuracy  of local_reflection()
/// Errors    ContractViolation outside the domain
[[nodiscard]] Eigen::Array3d reflection_of_cosines(const LocalReflection& surface, const Eigen::Array3d& ambient_light,
                                                   std::span<const LightCosines> cosines,
                                                   std::span<const Eigen::Array3d> intensities);

}  // namespace etendue
