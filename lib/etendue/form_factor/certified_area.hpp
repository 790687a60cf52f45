// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "etendue/form_factor/certified_outline.hpp"

namespace etendue {

/// An interval that holds the double area integral by a tensor Gauss rule, for outlines apart:
///
///     2 ∫_A1 ∫_A2  cos a_1 cos a_2 / r²  dA_2 dA_1 = 2π A_1 F_12                              @eq IU.6-3
///
/// Symbols   r distance [length]; a_1, a_2 angles to the normals [rad]
/// Domain    any two outlines, each the sum of the triangles of a fan (signed, so concave ones count right)
/// Returns   the enclosure with a truncation of about `goal`, or nothing where the outlines are not certainly apart or
///           more than `budget` evaluations of the kernel would be needed; `work` is raised by those spent
/// Accuracy  inclusion proved: NOTES.md §4, §10. Keeps its relative width at any distance
/// Errors    none
[[nodiscard]] std::optional<Interval> enclosed_area(const EnclosedOutline& first, const EnclosedOutline& second,
                                                    double goal, std::int64_t budget, std::int64_t& work);

}  // namespace etendue
