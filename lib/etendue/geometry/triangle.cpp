// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/triangle.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/processor.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/kept_near.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/resolved.hpp"
#include "etendue/geometry/shear.hpp"

namespace etendue {

namespace {

// The plane of the corners: its normal, of the length of twice the area, and where the ray meets it.
struct CornerPlane {
  DoubleDouble3 normal;
  std::optional<DoubleDouble> t;  // none where the ray is parallel to the plane
  bool degenerate = false;        // the corners lie on a line
};

CornerPlane corner_plane(const Ray& ray, const Triangle& triangle) {
  const DoubleDouble3 ab = exact_difference(triangle.b, triangle.a), ac = exact_difference(triangle.c, triangle.a);
  const DoubleDouble3 offset = exact_difference(triangle.a, ray.origin);
  const DoubleDouble3 direction = widened(ray.direction);
  CornerPlane plane{cross(ab, ac), std::nullopt, false};
  const auto exact = [&](const DoubleDouble3& w) {
    const Expansion ux = ab.x, uy = ab.y, uz = ab.z, vx = ac.x, vy = ac.y, vz = ac.z;
    return (uy * vz - uz * vy) * Expansion(w.x) + (uz * vx - ux * vz) * Expansion(w.y) +
           (ux * vy - uy * vx) * Expansion(w.z);
  };
  // The magnitudes of the six products are at most twice the product of the lengths (Cauchy).
  const double area = 2 * (triangle.b - triangle.a).norm() * (triangle.c - triangle.a).norm();
  const DoubleDouble speed =
      resolved(dot(plane.normal, direction), area * ray.direction.norm(), [&] { return exact(direction); });
  if (speed.high == 0) {  // as it is for every direction where the normal is zero
    plane.degenerate = exact({1, 0, 0}).sign() == 0 && exact({0, 1, 0}).sign() == 0 && exact({0, 0, 1}).sign() == 0;
    return plane;
  }
  const double distance = (triangle.a - ray.origin).norm();
  plane.t = resolved(dot(plane.normal, offset), area * distance, [&] { return exact(offset); }) / speed;
  return plane;
}

double farthest_corner(const Triangle& triangle, const Vec3& point) {
  return std::max({(triangle.a - point).lpNorm<Eigen::Infinity>(), (triangle.b - point).lpNorm<Eigen::Infinity>(),
                   (triangle.c - point).lpNorm<Eigen::Infinity>()});
}

// A triangle as the ray sees it.
struct Seen {
  Sheared a, b, c;
  double u, v, w;  // of the edges bc, ca, ab: all of one sign, or zero, inside

  Seen(const Shear& shear, const Triangle& triangle, const Vec3& origin)
      : a(sheared(shear, triangle.a, origin)),
        b(sheared(shear, triangle.b, origin)),
        c(sheared(shear, triangle.c, origin)),
        u(edge_function(b, c)),
        v(edge_function(c, a)),
        w(edge_function(a, b)) {}

  double sum() const { return u + v + w; }
  bool passed_through() const { return !((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) && sum() != 0; }
  bool in_range(const Ray& ray) const {
    const double first = std::min({a.z, b.z, c.z}), last = std::max({a.z, b.z, c.z});
    return last > 0 && last > ray.t_min && first < ray.t_max;
  }
};

}  // namespace

bool TrianglePass::may_hit(const Triangle& triangle, double t_max) const {
  const Seen seen(shear_, triangle, ray_.origin);
  if (!seen.passed_through() || !seen.in_range(ray_)) return false;
  // A hit may lie by the shift before the nearest corner (kept_near).
  double reach = 0;
  for (const Sheared& p : {seen.a, seen.b, seen.c}) {
    reach = std::max(reach, std::abs(p.z) + std::abs(shear_.scale) * (std::abs(p.x) + std::abs(p.y)));
  }
  return std::min({seen.a.z, seen.b.z, seen.c.z}) - 4 * kTriangleShift * reach <= t_max;
}

ETENDUE_USES_FMA std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
  require_direction(ray);
  const Seen seen(shear_of(ray.direction), triangle, ray.origin);
  const auto& [a, b, c, u, v, w] = seen;
  const double sum = seen.sum();
  require(std::isfinite(sum), "intersect: the triangle's corners are finite");
  if (!seen.passed_through() || !seen.in_range(ray)) return std::nullopt;

  const double beta = v / sum, gamma = w / sum;
  const CornerPlane plane = corner_plane(ray, triangle);
  if (plane.degenerate) return std::nullopt;
  // A ray that passes an edge within the rounding of the shear may meet the plane outside the triangle, or nowhere.
  const DoubleDouble met = plane.t ? *plane.t : DoubleDouble(a.z + beta * (b.z - a.z) + gamma * (c.z - a.z));
  const DoubleDouble t = kept_near(ray, met, triangle.a.cwiseMin(triangle.b).cwiseMin(triangle.c),
                                   triangle.a.cwiseMax(triangle.b).cwiseMax(triangle.c),
                                   kTriangleShift * farthest_corner(triangle, ray.origin));
  if (!looks_at(ray, t.high)) return std::nullopt;
  const Vec3 normal = Vec3(rounded(plane.normal.x), rounded(plane.normal.y), rounded(plane.normal.z)).normalized();
  Hit hit = flat_hit(ray, t, normal);
  hit.uv = {beta, gamma};
  hit.point_error += std::abs(met.high - t.high) * ray.direction.norm();
  hit.surface_error += kTriangleShift * farthest_corner(triangle, hit.point);
  return hit;
}

}  // namespace etendue
