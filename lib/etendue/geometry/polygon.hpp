// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// How far a vertex may lie off a polygon's plane, as a share of the polygon's extent: 2^-40 ≈ 9·10⁻¹³. Coordinates
/// written with 13 significant digits or more pass, single precision (2^-24) does not: form factors keep 12 digits of a
/// flat polygon, and a polygon that is not flat is a mesh.
inline constexpr double kPlanarity = 0x1p-40;

/// The same as a share of the largest coordinate: what rounding the coordinates to double moves a vertex (√3 u), and
/// the plane with it, with a factor of 4 to spare.
inline constexpr double kCoordinateRounding = 0x1p-50;

/// Least area as a share of extent × largest coordinate: a polygon that is narrower than the rounding of its own
/// coordinates has no normal.
inline constexpr double kNarrowest = 0x1p-50;

/// Least edge (its largest coordinate difference) and greatest coordinate of a polygon, in any unit of length: beyond
/// these, products of lengths would underflow and lose digits, or overflow.
inline constexpr double kLeastEdge = 0x1p-200;
inline constexpr double kGreatestCoordinate = 0x1p200;

/// A simple planar polygon, convex or concave. Vertices run counter-clockwise as seen from the front.  @eq RT.11
class Polygon {
 public:
  /// Refuses fewer than three vertices, non-finite coordinates, coincident vertices, sizes out of the domain, zero area,
  /// vertices off the plane and crossing edges; the message names the vertex.
  ///
  /// Domain    extent ≥ kLeastExtent, coordinates ≤ kGreatestCoordinate in magnitude
  /// Accuracy  vertices times 2^k give the same normal, area times 4^k and centroid times 2^k, to the last bit: tested
  [[nodiscard]] static Result<Polygon> make(std::vector<Vec3> vertices);

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const Vec3& normal() const { return normal_; }      ///< unit; Newell's sum
  double area() const { return area_; }               ///< [length²]
  const Vec3& centroid() const { return centroid_; }  ///< of the area, not of the vertices

 private:
  Polygon() = default;
  std::vector<Vec3> vertices_;
  Vec3 normal_ = Vec3::UnitZ();
  double area_ = 0;
  Vec3 centroid_ = Vec3::Zero();
};

/// Where a ray meets a polygon: in its plane (@eq IU.5-12, IU.5-13, RT.12), inside its boundary (@eq IU.5.6.2, E16).
///
/// Domain    lengths between 2^-200 and 2^200; |D| between 2^-500 and 2^500
/// Returns   as for Plane; uv: coordinates from vertex 0, u along the first edge, v to its left, in scene units
/// Hits      the Jordan test across the ray, exact for corners moved by kTriangleShift: half of the boundary belongs to
///           it, the other half to the neighbour, and no ray slips between polygons that share an edge (exactly the
///           same doubles). A parallel ray is a miss
/// Accuracy  t within kPlaneUlps, for the plane through centroid() with normal(): proved, unless the ray passes an edge
///           within that shift at so low an angle that the plane's t is far from the polygon: t is then kept where the ray is in its box
/// Errors    ContractViolation where the ray is not finite or the direction zero
/// Source    [IU] 5.6.2, mended (docs/errata.md, E16, G9)
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Polygon& polygon);

}  // namespace etendue
