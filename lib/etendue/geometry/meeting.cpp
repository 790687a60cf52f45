// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/meeting.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/processor.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/resolved.hpp"

namespace etendue {

namespace {

// Each term of the sums below passes at most four roundings, its magnitude two more: NOTES.md §2.
constexpr double kSumFilter = gamma_bound(6);

struct Sum {
  double value;
  double magnitude;  // of the terms
};

Sum sum_of_products(const Vec3& a, const Vec3& b) {
  const double x = a.x() * b.x(), y = a.y() * b.y(), z = a.z() * b.z();
  return {x + y + z, std::abs(x) + std::abs(y) + std::abs(z)};
}

// Certainly outside the ray's range? `relative` bounds the relative error of t.
bool surely_outside(const Ray& ray, double t, double relative) {
  if (t < 0 && relative < 1) return true;
  const double slack = std::abs(t) * relative;
  return t - slack > ray.t_max || t + slack < ray.t_min;
}

Expansion exact_dot(const DoubleDouble3& a, const Vec3& b) {
  return Expansion(a.x) * b.x() + Expansion(a.y) * b.y() + Expansion(a.z) * b.z();
}

}  // namespace

void require_direction(const Ray& ray) {
  const double length = ray.direction.squaredNorm();
  require(length > 0 && std::isfinite(length), "intersect: the ray's direction is finite and not zero");
  require(ray.origin.allFinite(), "intersect: the ray's origin is finite");
}

ETENDUE_USES_FMA std::optional<DoubleDouble> meet_plane(const Ray& ray, const Vec3& normal, const Vec3& point) {
  const Vec3 offset = point - ray.origin;
  const Sum height = sum_of_products(normal, offset);
  const Sum speed = sum_of_products(normal, ray.direction);
  const double height_error = kSumFilter * height.magnitude, speed_error = kSumFilter * speed.magnitude;
  if (std::abs(speed.value) > 2 * speed_error && std::abs(height.value) > 2 * height_error) {
    const double relative = 4 * (height_error / std::abs(height.value) + speed_error / std::abs(speed.value));
    if (surely_outside(ray, height.value / speed.value, relative)) return std::nullopt;
  }
  const auto t = line_meets_plane(ray, normal, point);
  return t && looks_at(ray, t->high) ? t : std::nullopt;
}

ETENDUE_USES_FMA std::optional<DoubleDouble> line_meets_plane(const Ray& ray, const Vec3& normal, const Vec3& point) {
  const double speed_size = normal.cwiseProduct(ray.direction).lpNorm<1>();
  const DoubleDouble speed = resolved(dot(widened(ray.direction), normal), speed_size,
                                      [&] { return exact_dot(widened(ray.direction), normal); });
  if (speed.high == 0) return std::nullopt;
  const DoubleDouble3 offset = exact_difference(point, ray.origin);
  const double height_size = normal.cwiseProduct(point - ray.origin).lpNorm<1>();
  const DoubleDouble height = resolved(dot(offset, normal), height_size, [&] { return exact_dot(offset, normal); });
  return height / speed;
}

ETENDUE_USES_FMA Hit flat_hit(const Ray& ray, const DoubleDouble& t, const Vec3& normal) {
  Hit hit;
  hit.t = t.high;
  hit.point = rounded_along(widened(ray.origin), t, ray.direction);
  hit.normal = normal;
  // Two roundings' worth for one: the second pays for what DoubleDouble itself loses.
  const double rounding = 2 * kUnitRoundoff;
  const double along = kMeetingError * t.high;
  hit.point_error = rounding * hit.point.lpNorm<1>() + along * ray.direction.norm();
  hit.surface_error =
      rounding * normal.cwiseAbs().dot(hit.point.cwiseAbs()) + along * std::abs(normal.dot(ray.direction));
  return hit;
}

TangentFrame tangent_frame(const Vec3& normal) {
  const double sign = std::copysign(1.0, normal.z());
  const double a = -1 / (sign + normal.z());
  const double b = normal.x() * normal.y() * a;
  return {{1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x()},
          {b, sign + normal.y() * normal.y() * a, -normal.y()}};
}

}  // namespace etendue
