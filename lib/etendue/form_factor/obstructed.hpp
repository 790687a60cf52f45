// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/core/bounded.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// Form factor F_12 where the convex polygons `blockers` (two-sided) stand in the way.             @eq IU.6-4
[[nodiscard]] Bounded obstructed_form_factor(const Polygon& from, const Polygon& to, std::span<const Polygon> blockers,
                                             Tolerance tolerance = {});

}  // namespace etendue
