// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/core/processor.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/double_double3.hpp"
#include "etendue/geometry/meeting.hpp"

namespace etendue {

namespace {

// A root of the quadratic and a bound on its error.
struct Root {
  DoubleDouble t;
  double error = 0;
};

// Everything about the ray and the axis A that the roots need: with v = O − base, m = v × A and n = D × A,
//     |n|² t² + 2 m·n t + |m|² − R²|A|² = 0,   discriminant |A|² (|n|² R² − (A·(v × D))²).
struct Quadratic {
  DoubleDouble a, b, c, root;  // root of the discriminant
  double a_error, b_error, c_error, root_error;
  bool real;
};

double length(const DoubleDouble3& v) {
  return Vec3(v.x.high, v.y.high, v.z.high).norm();
}

// One share for all the sums below: at most 16 operations deep, each within 2^-102. NOTES.md §7.
constexpr double kLoss = 0x1p-97;

Quadratic quadratic(const DoubleDouble3& v, const DoubleDouble3& axis, const DoubleDouble3& d, double radius) {
  const DoubleDouble3 m = cross(v, axis), n = cross(d, axis);
  const DoubleDouble axis_square = dot(axis, axis), square = exact_product(radius, radius);
  const DoubleDouble volume = dot(axis, cross(v, d));
  const double v_length = length(v), d_length = length(d), a_length = length(axis);
  const double m_length = length(m), n_length = length(n);
  const double m_error = kLoss * v_length * a_length, n_error = kLoss * d_length * a_length;
  Quadratic q;
  q.a = dot(n, n);
  q.a_error = n_error * (2 * n_length + n_error) + kLoss * n_length * n_length;
  q.b = dot(m, n);
  q.b_error = m_length * n_error + n_length * m_error + m_error * n_error + kLoss * m_length * n_length;
  q.c = dot(m, m) - square * axis_square;
  const double wall = radius * a_length;
  q.c_error = m_error * (2 * m_length + m_error) + kLoss * (m_length * m_length + wall * wall);
  const DoubleDouble discriminant = q.a * square - volume * volume;
  const double volume_error = kLoss * a_length * v_length * d_length;
  const double error = radius * radius * q.a_error + volume_error * (2 * std::abs(volume.high) + volume_error) +
                       kLoss * radius * radius * q.a.high;
  q.real = discriminant.high > 0 && q.a.high > 0;
  q.root = sqrt(axis_square) * sqrt(discriminant);
  const double plain = q.root.high / a_length;
  q.root_error = a_length * (plain > 0 ? std::min(error / plain, std::sqrt(error)) : 0) + kLoss * q.root.high;
  return q;
}

// Both roots in order; every sum adds numbers of one sign.
void roots(const Quadratic& q, Root& near, Root& far) {
  const bool negative = q.b.high <= 0;
  const DoubleDouble sum = negative ? q.root - q.b : -(q.root + q.b);
  const double sum_error = q.root_error + q.b_error;
  Root by_a{sum / q.a, 0}, by_c{q.c / sum, 0};
  by_a.error = 2 * (sum_error + std::abs(by_a.t.high) * q.a_error) / q.a.high;
  by_c.error = 2 * (q.c_error + std::abs(by_c.t.high) * sum_error) / std::abs(sum.high);
  near = negative ? by_c : by_a;
  far = negative ? by_a : by_c;
  // An origin within rounding of the surface is on it, and does not hit at t = 0.
  if (std::abs(q.c.high) <= q.c_error) (negative ? near : far).t = 0;
}

}  // namespace

ETENDUE_USES_FMA std::optional<Hit> intersect(const Ray& ray, const Cylinder& cylinder) {
  require_direction(ray);
  require(cylinder.radius > 0, "intersect: the cylinder's radius is positive");
  require(cylinder.base != cylinder.top, "intersect: the cylinder's ends are apart");
  require(cylinder.base.allFinite() && cylinder.top.allFinite() && std::isfinite(cylinder.radius),
          "intersect: the cylinder's ends and radius are finite");
  const DoubleDouble3 v = exact_difference(ray.origin, cylinder.base);
  const DoubleDouble3 axis = exact_difference(cylinder.top, cylinder.base);
  const Quadratic q = quadratic(v, axis, widened(ray.direction), cylinder.radius);
  if (!q.real) return std::nullopt;
  Root near, far;
  roots(q, near, far);
  const DoubleDouble axis_square = dot(axis, axis);
  const DoubleDouble start = dot(v, axis), speed = dot(axis, ray.direction);
  for (const Root& root : {near, far}) {
    if (!looks_at(ray, root.t.high)) continue;
    const DoubleDouble height = (start + root.t * speed) / axis_square;  // 0 at the base, 1 at the top
    if (height.high < 0 || DoubleDouble(1) < height) continue;
    const auto radial = [&](const DoubleDouble& from, double along, const DoubleDouble& up) {
      return rounded(from + root.t * along - height * up);
    };
    Hit hit;
    hit.t = root.t.high;
    hit.normal = Vec3(radial(v.x, ray.direction.x(), axis.x), radial(v.y, ray.direction.y(), axis.y),
                      radial(v.z, ray.direction.z(), axis.z))
                     .normalized();
    const Vec3 foot(rounded(height * axis.x + cylinder.base.x()), rounded(height * axis.y + cylinder.base.y()),
                    rounded(height * axis.z + cylinder.base.z()));
    hit.point = foot + cylinder.radius * hit.normal;
    hit.surface_error = kUnitRoundoff * (2 * foot.lpNorm<1>() + 2 * hit.point.lpNorm<1>() + 8 * cylinder.radius);
    hit.point_error = hit.surface_error + (root.error + 2 * kUnitRoundoff * 0x1p-40 * hit.t) * ray.direction.norm();
    const TangentFrame frame = tangent_frame(Vec3(axis.x.high, axis.y.high, axis.z.high).normalized());
    const double turn = std::atan2(frame.v.dot(hit.normal), frame.u.dot(hit.normal)) / (2 * std::numbers::pi);
    hit.uv = {turn < 0 ? turn + 1 : turn, rounded(height)};
    return hit;
  }
  return std::nullopt;
}

}  // namespace etendue
