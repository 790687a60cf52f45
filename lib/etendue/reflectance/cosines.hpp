// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/rounding.hpp"
#include "etendue/reflectance/local.hpp"

namespace etendue {

/// The two scalar products of a light that the local model rests on, unlimited: what dot-product interpolation carries from
/// the corners of a polygon into it.
struct LightCosines {
  double incidence = 0;  ///< N·L
  double mirror = 0;     ///< R·V = 2 (N·L)(N·V) − L·V
};

/// Bound on the absolute error of either: three products of 3.1 u, and four roundings of a sum of three at most.
constexpr double cosines_error() {
  return 14 * kUnitRoundoff;
}

/// Both products.                                                                     @eq IU.3.4, IU.2-7
/// Without a reflected vector there is nothing to divide and no root to draw: what is shaded at every pixel is shaded so.
/// Domain    unit vectors (kUnitTolerance)
/// Accuracy  cosines_error(), of the scalar products of the given vectors; proved as for lambert()
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
