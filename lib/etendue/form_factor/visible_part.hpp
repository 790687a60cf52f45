// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// The parts of `receiver` that the origin sees past the convex, two-sided `blockers`; all loops relative to the
/// origin. The shadow of a blocker is what lies inside the cone from the origin over its edges and beyond its plane;
/// each half-space of it cuts one part off, so nothing is projected and no case is special.
///
/// Domain    receiver simple, convex or concave; a blocker whose plane holds the origin has no shadow
/// Returns   loops whose line integrals add up to the visible part's (concave ones with edges run to and fro)
/// Errors    none
[[nodiscard]] std::vector<std::vector<Vec3>> visible_part(std::vector<Vec3> receiver,
                                                          std::span<const std::vector<Vec3>> blockers);

}  // namespace etendue
