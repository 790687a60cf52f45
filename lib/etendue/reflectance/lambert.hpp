// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Bound on the absolute error of lambert(): three roundings of products that sum to at most
/// one, optics/NOTES.md §1.
constexpr double lambert_error() {
  return 3.1 * kUnitRoundoff;
}

/// Lambert's cosine: the share of a light's intensity that falls on a surface turned away from it by θ.
///
///     cos θ = max(0, N·L);   I = k_d I_p cos θ                                               @eq IU.2-2, IU.2-3
///
/// Symbols   N unit normal on the viewed side; L unit vector towards the light; θ between them (the product is its
///           cosine, not the angle: E8)
/// Domain    unit vectors (kUnitTolerance)
/// Returns   N·L, or 0 for a light behind the surface, which the printed formula would subtract (G1)
/// Accuracy  lambert_error() against the scalar product of the given vectors, proved
/// Errors    ContractViolation if either is not a unit vector, as an interpolated normal is not before it is normalised
[[nodiscard]] double lambert(const Vec3& normal, const Vec3& to_light);

}  // namespace etendue
