// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/view_body.hpp"

namespace etendue {

/// Factor from a differential element to what it sees of `patch` past `blockers`, where any of them may be round.
///
///     F = (1/2π) ∮ n · (p' × p)/|p|² dx   around all that is seen                        @eq IU.6-2, IU.6-4, IU.6-10
///
/// The boundary of what is seen consists of pieces of the outlines of the patch and of the blockers and of the element's
/// horizon, cut where they cross; each piece has a closed form (NOTES.md §13).
///
/// Symbols   n the element's unit normal, p the outline as seen from the element [length]
/// Domain    patch and blockers may touch; none may pierce another
/// Returns   value in [0, 1] and a bound
/// Accuracy  the bound counts the rounding of the pieces; that a gap or a sliver narrower than kViewOffset may be taken
///           for closed is in it. Measured: validation/form_factor/curved_view_test.cpp
[[nodiscard]] Bounded visible_point_to_patch(const Vec3& point, const Vec3& normal, const CurvedPatch& patch,
                                             std::span<const CurvedBlocker* const> blockers);

/// On either side of an outline it is looked this far [rad] beside it for what is seen there.
inline constexpr double kViewOffset = 0x1p-36;

}  // namespace etendue
