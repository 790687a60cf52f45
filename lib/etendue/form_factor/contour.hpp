// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// A sum, a bound on what quadrature cut off, and a bound on what rounding did to it.
struct QuadratureSum {
  double value = 0;
  double truncation = 0;
  double rounding = 0;
};

/// The double contour integral of Stokes' theorem applied twice:
///
///     ∮∮ ln r dr_1 · dr_2 = 2π A_1 F_12                                                       @eq IU.6-3
///
/// Symbols   r distance between the running points of the two closed loops [length]
/// Domain    any two closed loops, touching or not; vertices near the origin (say, within a few diameters)
/// Returns   value, |truncation| ≤ about `goal` where it can be reached, and rounding [length²]
/// Accuracy  |value − integral| ≤ truncation + rounding; truncation proved, rounding counted: NOTES.md §3
/// Errors    none
/// Source    Sparrow 1963; the coplanar pair as in Schröder and Hanrahan 1993
[[nodiscard]] QuadratureSum double_contour(std::span<const Vec3> first, std::span<const Vec3> second, double goal);

}  // namespace etendue
