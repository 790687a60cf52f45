// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/form_factor/loop.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// What of two one-sided polygons can see one another, each around an origin of its own (the first vertex), both scaled
/// by one power of two to a size of order one: no digit is lost to a common offset, and none changes with the unit.
struct FacingPair {
  Loop from;             ///< the part in front of to's plane; no vertices where nothing is seen
  Loop to;               ///< the part in front of from's plane
  Vec3 offset;           ///< leads from from's origin to to's
  double from_area = 0;  ///< of the whole of from
  double moved = 0;      ///< bound on what the cuts do to A_1 F_12, also where nothing is seen [scaled length²]
  double scale = 1;      ///< scaled length per length

  bool sees() const { return !from.vertices.empty() && !to.vertices.empty(); }
};

/// Of two that turn the same way, vertices off the other's plane by the rounding of coordinates count as on it, so
/// touching polygons are not cut; `moved` pays for it. Of two that turn against one another, the side is exact.
[[nodiscard]] FacingPair facing_pair(const Polygon& from, const Polygon& to);

/// `vertices` around `origin`, scaled.
[[nodiscard]] std::vector<Vec3> localised(const std::vector<Vec3>& vertices, const Vec3& origin, double scale);

}  // namespace etendue
