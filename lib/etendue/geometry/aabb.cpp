// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/aabb.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

// A hit's point may lie off its shape by the rounding of a few operations on numbers of the shape's size; a ray is
// taken to hit a triangle whose corners are moved by kTriangleShift. One margin for all: NOTES.md §8.
constexpr double kMargin = 0x1p-48;

Aabb around(const Vec3& centre, const Vec3& reach) {
  const Vec3 margin = kMargin * (centre.cwiseAbs() + Vec3::Constant(centre.lpNorm<Eigen::Infinity>()) + reach +
                                 Vec3::Constant(reach.maxCoeff()));
  return {centre - reach - margin, centre + reach + margin};
}

Aabb widened_box(const Aabb& box) {
  const Vec3 margin =
      Vec3::Constant(kMargin * std::max(box.low.lpNorm<Eigen::Infinity>(), box.high.lpNorm<Eigen::Infinity>()));
  return {box.low - margin, box.high + margin};
}

// Half extents of a disc of radius 1 with this unit normal.
Vec3 disc_reach(const Vec3& normal) {
  return (Vec3::Ones() - normal.cwiseProduct(normal)).cwiseMax(0).cwiseSqrt();
}

}  // namespace

Aabb united(const Aabb& a, const Aabb& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

Aabb united(const Aabb& a, const Vec3& point) {
  return {a.low.cwiseMin(point), a.high.cwiseMax(point)};
}

Aabb bounds(const Sphere& sphere) {
  return around(sphere.centre, Vec3::Constant(sphere.radius));
}

Aabb bounds(const Disc& disc) {
  // 1 − n² loses up to 2 u, whose root is 2^-26: added rather than analysed, discs are few.
  return around(disc.centre, disc.radius * (disc_reach(disc.normal) + Vec3::Constant(0x1p-25)));
}

Aabb bounds(const Cylinder& cylinder) {
  const Vec3 reach =
      cylinder.radius * (disc_reach((cylinder.top - cylinder.base).normalized()) + Vec3::Constant(0x1p-25));
  return united(around(cylinder.base, reach), around(cylinder.top, reach));
}

Aabb bounds(const Box& box) {
  return around(box.centre, box.axes.cwiseAbs() * box.half_edges);
}

Aabb bounds(const Triangle& triangle) {
  return widened_box(united(united(united(Aabb{}, triangle.a), triangle.b), triangle.c));
}

Aabb bounds(const Polygon& polygon) {
  Aabb box;
  for (const Vec3& v : polygon.vertices()) box = united(box, v);
  const double off_plane = 2 * kPlanarity * (box.high - box.low).maxCoeff();
  const Vec3 margin = Vec3::Constant(off_plane);
  return widened_box({box.low - margin, box.high + margin});
}

Aabb bounds(const PolygonWithHoles& polygon) {
  return bounds(polygon.outline());
}

Aabb bounds(const Mesh& mesh) {
  Aabb box;
  for (const auto& triangle : mesh.triangles) {
    for (const auto corner : triangle) box = united(box, mesh.vertices[corner]);
  }
  return box.empty() ? box : widened_box(box);
}

Aabb bounds(const Cone& cone) {
  const Vec3 reach = disc_reach((cone.top - cone.base).normalized()) + Vec3::Constant(0x1p-25);
  return united(around(cone.base, cone.base_radius * reach), around(cone.top, cone.top_radius * reach));
}

Aabb bounds(const Torus& torus) {
  const Vec3 ring = torus.ring * (disc_reach(torus.axis.stableNormalized()) + Vec3::Constant(0x1p-25));
  return around(torus.centre, ring + Vec3::Constant(torus.tube));
}

Aabb bounds(const Quadric& quadric) {
  // A meeting counts as inside up to 2^-50 of the box's size beyond it, less than the margin.
  return bounds(quadric.box);
}

Aabb bounds(const BezierSurface& surface) {
  Aabb box;
  for (const auto& row : surface.control) {
    for (const Vec3& p : row) box = united(box, p);
  }
  // Parameters up to kBezierEdge beyond the edges count; no derivative exceeds three times the net.
  const Vec3 margin = Vec3::Constant(8 * kBezierEdge * (box.high - box.low).maxCoeff());
  return widened_box({box.low - margin, box.high + margin});
}

RayBoxTest::RayBoxTest(const Ray& ray)
    : origin_(ray.origin),
      inverse_(ray.direction.cwiseInverse()),
      t_min_(std::max(0.0, ray.t_min)),
      reach_(ray.origin.lpNorm<Eigen::Infinity>()) {}

bool RayBoxTest::meets(const Aabb& box, double t_max) const {
  if (box.empty()) return false;
  const double far_corner = std::max(box.low.lpNorm<Eigen::Infinity>(), box.high.lpNorm<Eigen::Infinity>());
  const double margin = kMargin * (reach_ + far_corner);
  double first = t_min_, last = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = (box.low[axis] - margin - origin_[axis]) * inverse_[axis];
    const double high = (box.high[axis] + margin - origin_[axis]) * inverse_[axis];
    // A NaN (direction 0 and origin on the slab's face) fails both comparisons and leaves the interval as it is.
    const bool forward = inverse_[axis] > 0;
    const double near = forward ? low : high;
    const double far = (forward ? high : low) * (1 + 2 * gamma_bound(3));
    if (near > first) first = near;
    if (far < last) last = far;
  }
  return first <= last;
}

bool meets(const Ray& ray, const Aabb& box) {
  return RayBoxTest(ray).meets(box, ray.t_max);
}

}  // namespace etendue
