// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "etendue/form_factor/sight_zone.hpp"
#include "etendue/form_factor/view_side.hpp"

namespace etendue {

/// On which sides of the planes over one another's edges the corners of a zone's loops lie, as seen from all of the zone:
/// what critical lines and event curves are found by. Loop 0 is the receiver, the others are the outlines.
///
/// Sides are found when they are asked for, of all corners of a loop at once.
class LoopSides {
 public:
  struct Edge {
    std::size_t loop, index;
  };

  /// Refers to both as long as it lives.
  LoopSides(std::span<const Vec3> receiver, const SightZone& zone);

  const SightZone& zone() const { return zone_; }
  std::size_t size() const { return loops_.size(); }
  std::span<const Vec3> loop(std::size_t i) const { return loops_[i]; }
  std::size_t after(std::size_t loop, std::size_t corner) const {
    return corner + 1 < loops_[loop].size() ? corner + 1 : 0;
  }
  const Vec3& start(const Edge& edge) const { return loops_[edge.loop][edge.index]; }
  const Vec3& end(const Edge& edge) const { return loops_[edge.loop][after(edge.loop, edge.index)]; }

  bool receiver_is_convex() const { return receiver_is_convex_; }

  /// Of a corner of a loop over an edge of another.
  const ViewSide& side(const Edge& edge, std::size_t loop, std::size_t corner) {
    return sides_[index(edge, loop, corner)];
  }
  /// 1 or −1 where that is its sign from all of the zone, else 0.
  int sign(const Edge& edge, std::size_t loop, std::size_t corner) { return signs_[index(edge, loop, corner)]; }

  /// Whether two loops lie beside one another from all of the zone: all corners of the one outside of an edge of the other.
  /// An outline is the same way round as a convex region; only of outlines edges are taken.
  bool apart(std::size_t one, std::size_t other);
  /// Whether two edges cross from no point of the zone: both ends of either lie on one side of the other.
  bool never_cross(const Edge& one, const Edge& other) { return beside(one, other) || beside(other, one); }
  /// Whether an edge lies outside of one edge of the receiver from all of the zone, and which these are: bit by bit, the
  /// first 64 of them. Nothing where the receiver is not convex.
  std::uint64_t beyond_receiver(const Edge& edge);

 private:
  std::size_t index(const Edge& edge, std::size_t loop, std::size_t corner) {
    std::size_t& row = rows_[(first_[edge.loop] + edge.index) * loops_.size() + loop];
    if (row == 0) {
      row = sides_.size() + 1;
      add_row(edge, loop);
    }
    return row - 1 + corner;
  }
  void add_row(const Edge& edge, std::size_t loop);
  bool outside(std::size_t loop, std::size_t outline);
  bool beside(const Edge& edge, const Edge& other);

  const SightZone& zone_;
  std::vector<std::span<const Vec3>> loops_;
  std::vector<std::size_t> first_;  ///< edges of all loops before
  std::vector<std::size_t> rows_;   ///< by edge and loop: one more than the first of sides_; 0 where not made yet
  std::vector<ViewSide> sides_;
  std::vector<signed char> signs_;
  std::vector<signed char> apart_;  ///< by the two loops; −1 where not known yet
  bool receiver_is_convex_ = true;
};

}  // namespace etendue
