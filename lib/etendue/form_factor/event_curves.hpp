// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/form_factor/cell.hpp"

namespace etendue {

/// Three edges that one line of sight can meet at once. Where it does, a corner of the visible part is covered or
/// uncovered: the zero of det(a_i × b_i), a conic in the source's plane.
class EventCurve {
 public:
  struct Edge {
    Vec3 start, end;
  };
  EventCurve(const Edge& first, const Edge& second, const Edge& third);

  /// Zero on the curve; quadratic in x.
  double at(const Vec2& x) const;
  /// False only where no line of sight from the cell meets all three, but for strips within kTouch of its outline: two of
  /// the edges do not cross one another in the view, or the curve's Bernstein coefficients have one sign.
  bool may_cross(const Cell& cell) const;
  bool operator==(const EventCurve& other) const;

 private:
  Edge edges_[3];
};

/// The curves that may cross the cell: of all edges that may cross one another, pairwise, as seen from some point of it.
/// Whether two may is settled by the ends of either over the plane of the other, affine functions on the cell.
[[nodiscard]] std::vector<EventCurve> event_curves(std::span<const Vec3> receiver, std::span<const Outline> outlines,
                                                   const Cell& cell);

}  // namespace etendue
