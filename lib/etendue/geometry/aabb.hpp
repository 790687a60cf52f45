// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/box.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/mesh.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/ray.hpp"
#include "etendue/geometry/sphere.hpp"
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

/// A box that contains every point of the shape and every Hit::point on it: rounded outward, proved (NOTES.md §8).
[[nodiscard]] Aabb bounds(const Sphere& sphere);
[[nodiscard]] Aabb bounds(const Disc& disc);
[[nodiscard]] Aabb bounds(const Cylinder& cylinder);
[[nodiscard]] Aabb bounds(const Box& box);
[[nodiscard]] Aabb bounds(const Triangle& triangle);
[[nodiscard]] Aabb bounds(const Polygon& polygon);
[[nodiscard]] Aabb bounds(const Mesh& mesh);

/// Slab test of one ray against many boxes. Conservative: where intersect(ray, shape) hits, meets(bounds(shape)) is
/// true. Source    Ize 2013, Robust BVH Ray Traversal
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
