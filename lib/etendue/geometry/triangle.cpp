// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/triangle.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/predicates.hpp"
#include "etendue/geometry/resolved.hpp"

namespace etendue {

namespace {

// The ray turned into the z axis: axes permuted so that z is the direction's largest component, then sheared.
struct Shear {
  int x, y, z;
  double along_x, along_y, scale;
};

struct Sheared {
  double x, y, z;
};

Shear shear_of(const Vec3& direction) {
  int z = 0;
  direction.cwiseAbs().maxCoeff(&z);
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  return {x, y, z, direction[x] / direction[z], direction[y] / direction[z], 1 / direction[z]};
}

Sheared sheared(const Shear& shear, const Vec3& corner, const Vec3& origin) {
  const double x = corner[shear.x] - origin[shear.x], y = corner[shear.y] - origin[shear.y];
  const double z = corner[shear.z] - origin[shear.z];
  return {x - shear.along_x * z, y - shear.along_y * z, shear.scale * z};
}

// Twice the signed area of (0, p, q). The two products are rounded separately, so the value changes its sign and
// nothing else when p and q change places, and its sign is wrong only by being 0: two neighbours agree on their common
// edge. Contraction of either product destroys both properties.
double edge_function(const Sheared& p, const Sheared& q) {
  const double value = p.x * q.y - p.y * q.x;
  if (value != 0) return value;
  return difference_of_products(p.x, q.y, p.y, q.x);
}

// The plane of the corners: its normal, of the length of twice the area, and where the ray meets it.
struct CornerPlane {
  DoubleDouble3 normal;
  std::optional<DoubleDouble> t;  // none where the ray is parallel to the plane
};

CornerPlane corner_plane(const Ray& ray, const Triangle& triangle) {
  const DoubleDouble3 ab = exact_difference(triangle.b, triangle.a), ac = exact_difference(triangle.c, triangle.a);
  const DoubleDouble3 offset = exact_difference(triangle.a, ray.origin);
  const DoubleDouble3 direction = widened(ray.direction);
  CornerPlane plane{cross(ab, ac), std::nullopt};
  const auto exact = [&](const DoubleDouble3& w) {
    const Expansion ux = ab.x, uy = ab.y, uz = ab.z, vx = ac.x, vy = ac.y, vz = ac.z;
    return (uy * vz - uz * vy) * Expansion(w.x) + (uz * vx - ux * vz) * Expansion(w.y) +
           (ux * vy - uy * vx) * Expansion(w.z);
  };
  // The magnitudes of the six products are at most twice the product of the lengths (Cauchy).
  const double area = 2 * (triangle.b - triangle.a).norm() * (triangle.c - triangle.a).norm();
  const DoubleDouble speed =
      resolved(dot(plane.normal, direction), area * ray.direction.norm(), [&] { return exact(direction); });
  if (speed.high == 0) return plane;
  const double distance = (triangle.a - ray.origin).norm();
  plane.t = resolved(dot(plane.normal, offset), area * distance, [&] { return exact(offset); }) / speed;
  return plane;
}

double farthest_corner(const Triangle& triangle, const Vec3& point) {
  return std::max({(triangle.a - point).lpNorm<Eigen::Infinity>(), (triangle.b - point).lpNorm<Eigen::Infinity>(),
                   (triangle.c - point).lpNorm<Eigen::Infinity>()});
}

}  // namespace

std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
  require_direction(ray);
  const Shear shear = shear_of(ray.direction);
  const Sheared a = sheared(shear, triangle.a, ray.origin);
  const Sheared b = sheared(shear, triangle.b, ray.origin);
  const Sheared c = sheared(shear, triangle.c, ray.origin);
  const double u = edge_function(b, c), v = edge_function(c, a), w = edge_function(a, b);
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
  const double sum = u + v + w;
  if (sum == 0) return std::nullopt;
  const double first = std::min({a.z, b.z, c.z}), last = std::max({a.z, b.z, c.z});
  if (last <= 0 || last <= ray.t_min || first >= ray.t_max) return std::nullopt;

  const double beta = v / sum, gamma = w / sum;
  const CornerPlane plane = corner_plane(ray, triangle);
  // A ray that passes an edge within the rounding of the shear may meet the plane outside the triangle, or nowhere.
  const DoubleDouble met = plane.t ? *plane.t : DoubleDouble(a.z + beta * (b.z - a.z) + gamma * (c.z - a.z));
  const DoubleDouble t = met.high < first ? DoubleDouble(first) : met.high > last ? DoubleDouble(last) : met;
  if (!looks_at(ray, t.high)) return std::nullopt;
  const Vec3 normal = Vec3(rounded(plane.normal.x), rounded(plane.normal.y), rounded(plane.normal.z)).normalized();
  Hit hit = flat_hit(ray, t, normal);
  hit.uv = {beta, gamma};
  hit.point_error += std::abs(met.high - t.high) * ray.direction.norm();
  hit.surface_error += kTriangleShift * farthest_corner(triangle, hit.point);
  return hit;
}

}  // namespace etendue
