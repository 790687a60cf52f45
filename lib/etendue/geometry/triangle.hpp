// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"
#include "etendue/geometry/shear.hpp"

namespace etendue {

/// Corners in counter-clockwise order as seen from the front.                                   @eq RT.9, RT.10
struct Triangle {
  Vec3 a, b, c;
};

/// Hit or miss is decided exactly for a triangle whose corners are moved by at most this share of the largest
/// coordinate of corner − origin (NOTES.md §5).
inline constexpr double kTriangleShift = 0x1p-49;

/// Where a ray meets a triangle: O + tD = (1 − β − γ) a + β b + γ c with β, γ, 1 − β − γ ≥ 0.       @eq RT.9, RT.10
///
/// Domain    lengths between 2^-120 and 2^120; |D| between 2^-500 and 2^500
/// Returns   t with max(0, t_min) < t < t_max; normal (b − a) × (c − a)/|…|, never flipped to the ray; uv = (β, γ)
/// Hits      edges and corners belong to the triangle: no ray slips between triangles that share them (exactly the same
///           doubles), whatever its direction. Degenerate ones (zero area) are misses; so are parallel rays and those in the
///           plane, but where one passes an edge within kTriangleShift: that edge is open like any other
/// Accuracy  hit or miss is exact for corners moved by kTriangleShift: proved. t within kPlaneUlps for the true plane
///           unless the ray passes over an edge within that shift: then t is kept where the ray is in the corners' box. The point
///           of such a hit may lie that far outside of the edge. β and γ carry the shift over the height of the
///           triangle
/// Errors    ContractViolation where the ray or a corner is not finite, or the direction zero
/// Note      needs -ffp-contract=off: validation/geometry/watertight_test.cpp fails where products are contracted
/// Source    Woop, Benthin and Wald 2013; R5 of docs/errata.md (t > 0)
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle);

/// The first, cheap part of intersect() for one ray and many triangles: whether the ray's line passes through one.
class TrianglePass {
 public:
  explicit TrianglePass(const Ray& ray) : ray_(ray), shear_(shear_of(ray.direction)) {}

  /// False only where intersect(ray, triangle) is a miss, or its t is above t_max.
  [[nodiscard]] bool may_hit(const Triangle& triangle, double t_max) const;

 private:
  const Ray& ray_;
  Shear shear_;
};

}  // namespace etendue
