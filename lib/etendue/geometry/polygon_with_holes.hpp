// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// A simple planar polygon from which others are cut: a wall with windows.
class PolygonWithHoles {
 public:
  /// Holes may run either way round. Refuses what Polygon::make refuses of each; a hole off the plane; edges of two
  /// chains that cross or touch; a hole outside the polygon or within another one. The message names the hole, counted
  /// from 0.
  [[nodiscard]] static Result<PolygonWithHoles> make(Polygon outline, std::vector<std::vector<Vec3>> holes);

  const Polygon& outline() const { return outline_; }
  const std::vector<std::vector<Vec3>>& holes() const { return holes_; }
  double area() const { return area_; }  ///< of what is left [length²]

 private:
  explicit PolygonWithHoles(Polygon outline) : outline_(std::move(outline)), area_(outline_.area()) {}
  Polygon outline_;
  std::vector<std::vector<Vec3>> holes_;
  double area_;
};

/// Where a ray meets a polygon with holes: as for its outline, but not within a hole.                  @eq IU.5.6.2
///
/// Hits      the Jordan test over all edges, the holes' too: no ray slips between the polygon and one that fills a hole
///           with exactly the same corners, nor hits both
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const PolygonWithHoles& polygon);

}  // namespace etendue
