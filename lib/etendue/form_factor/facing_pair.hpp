// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/form_factor/contour.hpp"
#include "etendue/form_factor/loop.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// A planar region as its boundary: the outline counter-clockwise as seen from the front, then holes clockwise.
using Boundary = std::vector<std::vector<Vec3>>;

/// What of two one-sided regions can see one another, both scaled by one power of two to a size of order one: no digit
/// is lost to a common offset, and none changes with the unit.
struct FacingRegions {
  /// What the contour takes: exact around the first vertex of `from`, but for the new corners of a cut, which err by
  /// kCutError of the coordinates. Empty where nothing is seen.
  std::vector<Chain> from, to;
  /// What the area rule takes: the same in double, each region around a first vertex of its own.
  std::vector<Loop> from_loops, to_loops;
  Vec3 offset = Vec3::Zero();  ///< leads from from's first vertex to to's
  double from_area = 0;        ///< of the whole of from, holes taken off
  double moved = 0;            ///< bound on what the cuts do to A_1 F_12, also where nothing is seen [scaled length²]
  double behind = 0;           ///< bound on what the contour counts, with its sign, of parts left behind a plane
  double scale = 1;            ///< scaled length per length
  bool flat = false;           ///< both exactly: Sides::exact would owe next to nothing

  bool sees() const { return !from.empty() && !to.empty(); }
};

/// Of two that turn the same way, vertices off the other's plane by the rounding of coordinates count as on it, so
/// touching polygons are not cut; `moved` and `behind` pay for it. Of two that turn against one another, the side is exact.
/// With Sides::exact, two exactly flat polygons are cut at the sign of every height, however small.
enum class Sides { rounded, exact };
[[nodiscard]] FacingRegions facing_regions(const Boundary& from, const Boundary& to, Sides sides = Sides::rounded);

/// The same for two polygons, each around an origin of its own (the first vertex).
struct FacingPair {
  Loop from;             ///< the part in front of to's plane; no vertices where nothing is seen
  Loop to;               ///< the part in front of from's plane
  Vec3 offset;           ///< leads from from's origin to to's
  double from_area = 0;  ///< of the whole of from
  double moved = 0;      ///< as above
  double scale = 1;      ///< scaled length per length

  bool sees() const { return !from.vertices.empty() && !to.vertices.empty(); }
};
[[nodiscard]] FacingPair facing_pair(const Polygon& from, const Polygon& to);

/// `vertices` around `origin`, scaled.
[[nodiscard]] std::vector<Vec3> localised(const std::vector<Vec3>& vertices, const Vec3& origin, double scale);

}  // namespace etendue
