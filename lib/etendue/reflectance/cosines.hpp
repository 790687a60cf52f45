// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/rounding.hpp"
#include "etendue/reflectance/local.hpp"

namespace etendue {

/// Bound on the absolute error of the first two products: three products of 3.1 u, and four roundings of a sum of three at most.
constexpr double cosines_error() {
  return 14 * kUnitRoundoff;
}

/// N·L and R·V; the others are zero.                                                  @eq IU.3.4, IU.2-7
/// Without a reflected vector there is nothing to divide and no root to draw: what is shaded at every pixel is shaded so.
/// Domain    unit vectors (kUnitTolerance)
/// Accuracy  cosines_error(), of the scalar products of the given vectors; proved as for lambert()
/// Errors    ContractViolation outside the domain
[[nodiscard]] LightCosines light_cosines(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer);

/// All five: a root and two quotients more. Where L = −V there is no H, and its products are zero.     @eq IU.2.7.1, IU.4.2.2
/// Accuracy  the further ones within 16 u while |L + V| ≥ 1/4; measured
[[nodiscard]] LightCosines all_light_cosines(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer);

/// local_reflection() from scalar products instead of vectors.                                       @eq IU.3.4, E30
///
///     I = k_a I_a + Σ_i f_i I_p,i [k_d max(0, N·L_i) + k_s max(0, R_i·V)ⁿ],   no second term where N·L_i ≤ 0
///
/// Interpolated products may be anything in [−1, 1]: they are limited here, after the interpolation, and the power is
/// taken here. The text interpolates the power, (R·V)ⁿ; then everything is a sum of interpolated numbers, and the
/// picture is Gouraud's (E30).
/// Domain    as many lights' cosines as intensities, all five products where surface.highlight is set; exponent finite, ≥ 1
/// Returns   red, green, blue; not limited above
/// Accuracy  of local_reflection()
/// Errors    ContractViolation outside the domain
[[nodiscard]] Eigen::Array3d reflection_of_cosines(const LocalReflection& surface, const Eigen::Array3d& ambient_light,
                                                   std::span<const LightCosines> cosines,
                                                   std::span<const Eigen::Array3d> intensities);

}  // namespace etendue
