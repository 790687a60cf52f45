// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/form_factor/loop.hpp"

namespace etendue {

/// A line in the source's plane, as the trace of a plane: normal · x = level there. Where the source crosses it between
/// `start` and `end` the visible part of the receiver gains or loses a corner, and the factor its smoothness.
struct CriticalLine {
  Vec3 normal;
  double level;
  Vec3 start;
  Vec3 end;
  bool bounded;  ///< false: the event may happen anywhere along the line
};

/// The lines in which the planes through a blocker's edge and a receiver's vertex, a blocker's vertex and a receiver's
/// edge, and the blockers' own planes cut the source's plane. Events of three blocker edges are curves and not listed.
///
/// Domain    blockers between the two planes: above source's, in front of receiver's
[[nodiscard]] std::vector<CriticalLine> critical_lines(const Loop& source, std::span<const Vec3> receiver,
                                                       std::span<const std::vector<Vec3>> blockers);

/// Whether the event may happen inside the convex `cell` of the source's plane.
[[nodiscard]] bool meets(const CriticalLine& line, std::span<const Vec3> cell);

}  // namespace etendue
