// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/geometry/interval3.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// A closed chain of corners, each known to lie within a box; those that were given are points.
using EnclosedOutline = std::vector<Interval3>;

/// The plane of a polygon, held exactly: through the first vertex, across the Newell sum.
class ExactPlane {
 public:
  /// `vertices` of a size between 2^-150 and 2^150.
  explicit ExactPlane(std::vector<Vec3> vertices);

  /// Newell's sum: the normal times twice the area.
  const Interval3& normal() const { return normal_; }

  /// Height above the plane times twice the area: exactly zero, or of certain sign and narrow.
  Interval height(const Vec3& point) const;
  /// The same for an enclosed point; the sign may be open.
  Interval height(const Interval3& point) const;

 private:
  Interval exact_height(const Vec3& point) const;

  std::vector<Vec3> vertices_;
  Interval3 normal_;
};

/// The part of `outline` where the heights are positive: Sutherland and Hodgman with enclosed cuts. Empty where no
/// height is positive.
///
/// Domain    heights that are zero or of certain sign
[[nodiscard]] EnclosedOutline clipped(const EnclosedOutline& outline, const std::vector<Interval>& heights);

/// What of two polygons can see one another, scaled by one power of two to a size of order one.
struct EnclosedPair {
  EnclosedOutline from, to;  ///< empty where nothing is seen
  Interval area;             ///< of the whole of from
  double scale = 1;
  bool flat = false;  ///< the corners of `to` lie exactly in one plane
};
[[nodiscard]] EnclosedPair enclosed_pair(const Polygon& from, const Polygon& to);

/// `vertices` times a power of two, which is exact.
[[nodiscard]] std::vector<Vec3> scaled(const std::vector<Vec3>& vertices, double scale);

}  // namespace etendue
