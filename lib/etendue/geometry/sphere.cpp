// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/sphere.hpp"

#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/core/processor.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/resolved.hpp"

namespace etendue {

namespace {

// Bound on the error of |D×v|² in double, as a share of |D|²|v|²: NOTES.md §4.
constexpr double kDistanceFilter = 32 * kUnitRoundoff;
// Bound on the relative error of |v|² and of R² in double, and of their comparison.
constexpr double kSideFilter = gamma_bound(8);

// The coefficients of a t² + 2bt + c = 0 and its discriminant b² − ac = aR² − |D×v|², all resolved.
struct Quadratic {
  DoubleDouble a, b, c, discriminant;
};

Expansion squared(const Expansion& x) {
  return x * x;
}

Expansion exact_discriminant(const DoubleDouble3& v, const Vec3& d, double radius) {
  const Expansion dx = d.x(), dy = d.y(), dz = d.z();
  const Expansion vx = v.x, vy = v.y, vz = v.z;
  const Expansion a = squared(dx) + squared(dy) + squared(dz);
  return a * squared(radius) - squared(dy * vz - dz * vy) - squared(dz * vx - dx * vz) - squared(dx * vy - dy * vx);
}

// Plain double, with margins: true only where the ray certainly misses.                @eq IU.5-9, IU.5-10
bool surely_misses(const Vec3& v, const Vec3& d, double radius) {
  const double square = radius * radius, lambda = v.squaredNorm(), a = d.squaredNorm();
  const Vec3 products = v.cwiseProduct(d);
  const bool outside = lambda > square * (1 + kSideFilter);
  if (outside && products.sum() > kSideFilter * products.lpNorm<1>()) return true;
  return v.cross(d).squaredNorm() > a * square + kDistanceFilter * a * lambda;
}

Quadratic quadratic(const DoubleDouble3& v, const Vec3& rounded_v, const Vec3& d, double radius) {
  const DoubleDouble3 wide = widened(d);
  const DoubleDouble square = exact_product(radius, radius);
  const double distance = rounded_v.norm();
  Quadratic q;
  q.a = dot(wide, d);
  q.b = resolved(dot(v, d), rounded_v.cwiseProduct(d).lpNorm<1>(),
                 [&] { return Expansion(v.x) * d.x() + Expansion(v.y) * d.y() + Expansion(v.z) * d.z(); });
  q.c = resolved(dot(v, v) - square, distance * distance + radius * radius,
                 [&] { return squared(v.x) + squared(v.y) + squared(v.z) - squared(radius); });
  const DoubleDouble3 moment = cross(v, wide);
  q.discriminant = resolved(q.a * square - dot(moment, moment), q.a.high * radius * (radius + distance),
                            [&] { return exact_discriminant(v, d, radius); });
  return q;
}

// The smallest root the ray looks at; every sum here adds numbers of one sign.                     @eq IU.5-11
std::optional<DoubleDouble> first_root(const Ray& ray, const Quadratic& q) {
  if (q.discriminant.high <= 0) return std::nullopt;
  const DoubleDouble root = sqrt(q.discriminant);
  const bool outside = q.c.high > 0, approaching = q.b.high < 0;
  if (!approaching) {
    if (q.c.high >= 0) return std::nullopt;
    const DoubleDouble far = -q.c / (q.b + root);
    return looks_at(ray, far.high) ? std::optional(far) : std::nullopt;
  }
  const DoubleDouble sum = root - q.b;
  if (outside) {
    const DoubleDouble near = q.c / sum;
    if (looks_at(ray, near.high)) return near;
  }
  const DoubleDouble far = sum / q.a;
  return looks_at(ray, far.high) ? std::optional(far) : std::nullopt;
}

}  // namespace

ETENDUE_USES_FMA std::optional<Hit> intersect(const Ray& ray, const Sphere& sphere) {
  require_direction(ray);
  require(sphere.radius > 0 && std::isfinite(sphere.radius), "intersect: the sphere's radius is positive and finite");
  require(sphere.centre.allFinite(), "intersect: the sphere's centre is finite");
  const Vec3 rounded_v = ray.origin - sphere.centre;
  if (surely_misses(rounded_v, ray.direction, sphere.radius)) return std::nullopt;
  const DoubleDouble3 v = exact_difference(ray.origin, sphere.centre);
  const auto t = first_root(ray, quadratic(v, rounded_v, ray.direction, sphere.radius));
  if (!t) return std::nullopt;
  Hit hit;
  hit.t = t->high;
  hit.normal = rounded_along(v, *t, ray.direction).normalized();
  hit.point = sphere.centre + sphere.radius * hit.normal;
  // The normal's direction, its length and the product: at most 8 roundings of the radius. NOTES.md §4.
  hit.surface_error = kUnitRoundoff * (2 * hit.point.lpNorm<1>() + 8 * sphere.radius);
  hit.point_error = hit.surface_error + 2 * kMeetingError * hit.t * ray.direction.norm();
  const double turn = std::atan2(hit.normal.y(), hit.normal.x()) / (2 * std::numbers::pi);
  hit.uv = {turn < 0 ? turn + 1 : turn,
            std::atan2(std::hypot(hit.normal.x(), hit.normal.y()), -hit.normal.z()) / std::numbers::pi};
  return hit;
}

}  // namespace etendue
