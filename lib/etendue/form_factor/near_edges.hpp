// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "etendue/form_factor/cell.hpp"
#include "etendue/form_factor/sight_zone.hpp"

namespace etendue {

/// Edges that pass close above the source, as that of a plate which stands on a floor and nearly touches the wall: over
/// a strip as wide as the gap all changes, and no rule on wide cells can know it. Cells are cut along such an edge into
/// strips, each at most kStrip times as wide as its far side is from the edge.
class NearEdges {
 public:
  /// `negligible`: area of a strip that need not be cut further, since what it holds does not count.
  NearEdges(std::span<const Vec3> receiver, const SightZone& zone, double negligible);

  [[nodiscard]] std::vector<Cell> graded(std::vector<Cell> cells) const;

  static constexpr double kStrip = 4;

 private:
  struct Edge {
    Vec2 normal;        ///< unit, across the edge as seen from above
    double level;       ///< normal · x on it
    double begin, end;  ///< along it
    double rise, from;  ///< its height: from + rise · along
  };
  void add(const Vec3& a, const Vec3& b, double size);
  /// Where the cell is to be cut along the edge; nothing where it is narrow enough, or not below the edge.
  [[nodiscard]] std::optional<double> cut_level(const Edge& edge, const Cell& cell) const;
  void grade(const Cell& cell, std::vector<Cell>& parts) const;

  std::vector<Edge> edges_;
  double negligible_;
};

}  // namespace etendue
