// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/core/bounded.hpp"
#include "etendue/core/result.hpp"
#include "etendue/form_factor/facing_pair.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// A planar region: a simple polygon less its holes. One-sided like its outline; every polygon is one.
class PlanarRegion {
 public:
  PlanarRegion(const Polygon& outline);  // NOLINT(google-explicit-constructor): a polygon without holes

  /// Refuses a hole that is no simple polygon, does not run clockwise as seen from the outline's front, leaves its
  /// plane, is not inside the outline, or meets the outline or another hole; the message names the hole and the vertex.
  [[nodiscard]] static Result<PlanarRegion> make(const Polygon& outline, const std::vector<std::vector<Vec3>>& holes);

  const Boundary& boundary() const { return boundary_; }  ///< the outline, then the holes
  const Vec3& normal() const { return normal_; }          ///< unit; the outline's
  double area() const { return area_; }                   ///< without the holes [length²]

 private:
  Boundary boundary_;
  Vec3 normal_;
  double area_;
};

/// form_factor() and point_to_polygon() with holes; contracts, bounds and accuracy are theirs.         @eq IU.6-2, IU.6-3
[[nodiscard]] Bounded form_factor(const PlanarRegion& from, const PlanarRegion& to, Tolerance tolerance = {});
[[nodiscard]] Bounded point_to_region(const Vec3& point, const Vec3& normal, const PlanarRegion& region);

}  // namespace etendue
