// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// How far a ray goes from an apex: a distance, to a line, to a circle.
struct PolarReach {
  enum class Kind { distance, line, circle } kind = Kind::distance;
  double size = 0;           ///< the distance; of the line from the apex; the circle's radius
  Vec2 from = Vec2::Zero();  ///< the line's unit normal; the circle's centre, from the apex
  double root = 1;           ///< −1: to where the circle is met first
  double along(const Vec2& direction) const;
};

/// The points between two such reaches, of all rays from an apex within an angle.
struct Wedge {
  Vec2 apex = Vec2::Zero();
  double turn = 0, turns = 0;  ///< first angle, and how much of it
  PolarReach inner, outer;
};

struct FlatCircle {
  Vec2 centre;
  double radius;
};

/// A convex part of a plane bounded by segments, counter-clockwise, and by arcs of one circle around the origin, the rim.
class FlatPart {
 public:
  static FlatPart polygon(std::vector<Vec2> corners);
  static FlatPart disc(double radius);

  /// What lies beyond the line normal · p = offset, and what before. What is nearer to the line than rounding counts as on
  /// it, and what only touches it is empty.
  std::pair<FlatPart, FlatPart> split(const Vec2& normal, double offset) const;

  bool empty() const { return corners_.empty(); }
  bool straight() const;
  const std::vector<Vec2>& corners() const { return corners_; }
  Vec2 middle() const;
  /// Does the inside of the circle reach into it?
  bool meets(const FlatCircle& circle) const;
  /// Wedges around an apex that share out the part but for what is nearer to the apex than `hole`.
  std::vector<Wedge> wedges(const Vec2& apex, double hole) const;

 private:
  struct Hit {
    double distance;
    PolarReach reach;
  };
  struct Span {
    double begin, end;
  };
  Span arc(std::size_t k) const;  ///< angles of the arc from corner k to the next
  Vec2 next(std::size_t k) const { return corners_[(k + 1) % corners_.size()]; }
  FlatPart cut_at_extremes(const Vec2& normal) const;
  void add(const Vec2& corner, bool arc);
  void drop_unless_wide();
  std::vector<double> turns(const Vec2& apex, double hole) const;
  std::vector<Hit> hits(const Vec2& apex, const Vec2& direction) const;

  std::vector<Vec2> corners_;
  std::vector<bool> arcs_;  ///< from each corner to the next: along the rim
  double rim_ = 0;
};

}  // namespace etendue
