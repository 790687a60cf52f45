// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Frost that makes all directions behind the surface alike; more there is not.
inline constexpr double kMostFrost = 0.5;

/// A direction in which a frosted surface sends on what a clear one sends along `clear`.                @eq IU.4.3d
///
///     p(α) = (m + 1)/(2π) cos^m α  about T  [1/sr],   m = (1 − 2f)/f,   so that the mean of cos α is 1 − f
///     cos α = a^(f/(1 − f)),   turn = 2π b
///
/// Of what would come back through the surface the part along the normal is turned over: all that enters goes on.
///
/// Symbols   T = clear; α the angle from T to the direction; f = frost; a, b two numbers, uniform in [0, 1)
/// Domain    unit vectors; T·N ≠ 0; f in [0, kMostFrost]: 0 gives T itself, kMostFrost each direction of the half-space about T
///           with the same probability
/// Returns   a unit vector on the side of the surface to which T points
/// Accuracy  measured: 2^-50 of one, directions as lengths
[[nodiscard]] Vec3 frosted(const Vec3& clear, const Vec3& normal, double frost, double a, double b);

}  // namespace etendue
