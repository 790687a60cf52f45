// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "etendue/form_factor/cell.hpp"
#include "etendue/form_factor/loop_sides.hpp"

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
  /// What the form seen from the cell's centre errs by beyond the curve, integrated over the cell; its area where two of the
  /// edges come near to covering one another.
  double stray(const Cell& cell) const;
  /// The same for a point where the determinant is this much: the factor of the triangle that the three edges leave.
  double gap(double determinant, const Cell& cell) const;
  bool operator==(const EventCurve& other) const;

 private:
  template <typename Note>
  void note_coefficients(const Cell& cell, const Note& note) const;

  Edge edges_[3];
};

/// The curves that may cross the cells of a zone: of all edges that may cross one another, pairwise, as seen from some
/// point of the cell. Whether two may is settled by the ends of either over the plane of the other, affine functions.
class EventCurves {
 public:
  /// Refers to `sides` as long as it lives.
  explicit EventCurves(LoopSides& sides);
  [[nodiscard]] std::vector<EventCurve> across(const Cell& cell) const;

 private:
  using Edge = LoopSides::Edge;
  /// Two edges of two loops that may cross from some point of the zone.
  struct Crossing {
    Edge one, other;
    std::array<ViewSide, 4> sides;  ///< of the ends of each over the other
  };
  struct Triple {
    std::array<std::size_t, 3> crossings;
    Edge first, second, third;  ///< the first two of outlines
  };
  class View;
  std::size_t add_crossing(const Edge& one, const Edge& other);
  void add_triples(std::size_t first, std::size_t second);
  EventCurve::Edge ends(const Edge& edge) const { return {sides_.start(edge), sides_.end(edge)}; }

  LoopSides& sides_;
  std::vector<Crossing> crossings_;
  std::vector<Triple> triples_;  ///< that may be met at once from some point of the zone
};

}  // namespace etendue
