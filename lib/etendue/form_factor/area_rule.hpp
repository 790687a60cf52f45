// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "etendue/form_factor/contour.hpp"
#include "etendue/form_factor/loop.hpp"

namespace etendue {

/// The double area integral by a tensor Gauss rule, for regions far apart compared with their sizes, each
/// its outline and then its holes:
///
///     2 ∫_A1 ∫_A2  cos a_1 cos a_2 / r²  dA_2 dA_1 = 2π A_1 F_12                              @eq IU.6-3
///
/// `offset` leads from the origin of `first`'s coordinates to that of `second`'s: neither loop's shape loses digits to
/// the distance.
///
/// Symbols   r distance [length]; a_1, a_2 angles to the normals [rad]
/// Domain    two regions wholly in front of one another; any simple loops (winding numbers do the rest)
/// Returns   the sum, or nothing where more than `budget` evaluations of the kernel would be needed for `goal`
/// Accuracy  |value − integral| ≤ truncation + rounding; truncation proved, rounding counted: NOTES.md §4
/// Errors    none
[[nodiscard]] std::optional<QuadratureSum> double_area(std::span<const Loop> first, std::span<const Loop> second,
                                                       const Vec3& offset, double goal, double budget);

}  // namespace etendue
