// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Bound on |computed − true| of reflect(), as a distance between vectors; hence also on how far its length is from 1,
/// and, to second order, on the angle [rad]. Proved in NOTES.md §2.
constexpr double reflection_error() {
  return 21 * kUnitRoundoff;
}

/// Direction of the ray that a mirror sends on.
///
///     ρ = δ − 2 (δ·s) s                                                               @eq RT.16, RT.19
///     R = 2 N' − V,  N' = N (N·V)     with V = −δ, N = s                              @eq IU.5-3, IU.5-4, IU.5-5
///
/// Symbols   δ incident direction, travelling towards the surface; s unit normal; V = −δ towards the viewer
/// Domain    unit vectors (kUnitTolerance); the normal may be on either side: the result is the same to the last bit
/// Returns   unit vector of the exact mirror direction of the two given directions: lengths that are not exactly one
///           are divided out, so that they do not build up along a path
/// Accuracy  reflection_error(), proved
/// Errors    ContractViolation if either is not a unit vector: with s = (0,0,2) the formula would give (1,0,7), R4
[[nodiscard]] Vec3 reflect(const Vec3& direction, const Vec3& normal);

}  // namespace etendue
