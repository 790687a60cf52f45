// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/geometry/double_double3.hpp"

namespace etendue {

/// A sum, a bound on what quadrature cut off, and a bound on what rounding did to it.
struct QuadratureSum {
  double value = 0;
  double truncation = 0;
  double rounding = 0;
};

/// A closed polygonal chain, exact around an origin near it.
using Chain = std::vector<DoubleDouble3>;

/// In which arithmetic a contour is integrated.
enum class Digits { single, twice };

/// The double contour integral of Stokes' theorem applied twice, over all chains of either region:
///
///     ∮∮ ln r dr_1 · dr_2 = 2π A_1 F_12                                                       @eq IU.6-3
///
/// Symbols   r distance between the running points of the two boundaries [length]
/// Domain    any closed chains, touching or not; all around one origin, of size and distance within order one
/// Returns   value, |truncation| ≤ about `goal` where it can be reached, and rounding [length²]
/// Accuracy  |value − integral| ≤ truncation + rounding; truncation proved, rounding counted: NOTES.md §3
/// Errors    none
/// Source    Sparrow 1963; the coplanar pair as in Schröder and Hanrahan 1993
[[nodiscard]] QuadratureSum double_contour(std::span<const Chain> first, std::span<const Chain> second, double goal,
                                           Digits digits);

}  // namespace etendue
