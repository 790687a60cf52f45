// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/form_factor/loop_sides.hpp"

namespace etendue {

/// A stretch of a line in the source's plane: normal · x = level, from `begin` to `end` along (−normal_y, normal_x).
/// Where the source crosses it the visible part of the receiver gains or loses a corner, and the factor its smoothness.
struct CriticalLine {
  Vec2 normal;  ///< unit
  double level;
  double begin;  ///< may be infinite
  double end;

  double height(const Vec2& x) const { return normal.dot(x) - level; }
  double along(const Vec2& x) const { return normal.x() * x.y() - normal.y() * x.x(); }
};

/// Where, seen from the zone, a corner of the receiver or of an outline passes an edge of another: the traces of the
/// planes through both, as far as the line of sight through the corner meets the edge itself and, between two
/// outlines, goes on to the receiver. Events of three edges are curves: see event_curves.hpp.
///
/// Domain    outlines between the two planes
/// Returns   those that meet the zone
[[nodiscard]] std::vector<CriticalLine> critical_lines(LoopSides& sides);
[[nodiscard]] std::vector<CriticalLine> critical_lines(std::span<const Vec3> receiver, const SightZone& zone);

}  // namespace etendue
