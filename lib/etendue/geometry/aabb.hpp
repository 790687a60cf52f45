// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/bezier.hpp"
#include "etendue/geometry/box.hpp"
#include "etendue/geometry/cone.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/mesh.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/polygon_with_holes.hpp"
#include "etendue/geometry/quadric.hpp"
#include "etendue/geometry/ray.hpp"
#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/torus.hpp"
#include "etendue/geometry/triangle.hpp"

namespace etendue {

/// Axis-aligned box, closed. The default is empty: the identity of united().
struct Aabb {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const { return !(low.array() <= high.array()).all(); }
  Vec3 centre() const { return low + (high - low) / 2; }
};

[[nodiscard]] Aabb united(const Aabb& a, const Aabb& b);
[[nodiscard]] Aabb united(const Aabb& a, const Vec3& point);

/// A box that contains every point of the shape and every Hit::point on it.                          @eq IU.5.7.1
///
/// A ray may hit a triangle over its edge, by kTriangleShift of its distance (triangle.hpp): such a point may lie
/// outside of the bounds by as much. RayBoxTest knows and does not lose the hit.
///
/// Domain    any shape; planes have no bounds
/// Returns   wider than the tight box by at most 2^-46 of the largest coordinate, and 2^-24 radii for discs,
///           cylinders, cones and tori, 2^-39 extents for polygons (twice kPlanarity); the empty box for a mesh without triangles
/// Accuracy  rounded outward, proved (NOTES.md §8)
[[nodiscard]] Aabb bounds(const Sphere& sphere);
[[nodiscard]] Aabb bounds(const Disc& disc);
[[nodiscard]] Aabb bounds(const Cylinder& cylinder);
[[nodiscard]] Aabb bounds(const Box& box);
[[nodiscard]] Aabb bounds(const Triangle& triangle);
[[nodiscard]] Aabb bounds(const Polygon& polygon);
[[nodiscard]] Aabb bounds(const PolygonWithHoles& polygon);  ///< its outline
[[nodiscard]] Aabb bounds(const Mesh& mesh);
[[nodiscard]] Aabb bounds(const Cone& cone);
[[nodiscard]] Aabb bounds(const Torus& torus);
[[nodiscard]] Aabb bounds(const Quadric& quadric);        ///< its box
[[nodiscard]] Aabb bounds(const BezierSurface& surface);  ///< its control points

/// Slab test of one ray against many boxes.
///
/// Accuracy  conservative, proved (NOTES.md §8): where intersect(ray, shape) hits, meets(bounds(shape), t_max) is true
///           for every t_max above the hit's t. The slabs are widened by 2^-48 of the coordinates, the far ends by 1 +
///           2γ_3
/// Domain    a direction other than zero; an empty box is never met
/// Source    Ize 2013, Robust BVH Ray Traversal
class RayBoxTest {
 public:
  explicit RayBoxTest(const Ray& ray);
  /// Whether the ray may meet something in `box` at a parameter below t_max.
  [[nodiscard]] bool meets(const Aabb& box, double t_max) const;

 private:
  Vec3 origin_, inverse_;
  double t_min_, reach_;
};

[[nodiscard]] bool meets(const Ray& ray, const Aabb& box);

}  // namespace etendue
