// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/predicates.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/double_double3.hpp"
#include "etendue/geometry/expansion.hpp"

namespace etendue {

namespace {

// Each term of a sum of n products of differences passes at most n + 2 roundings; one more pays for the rounding of the
// bound itself. NOTES.md §2.
constexpr double kOrientationFilter = gamma_bound(5);
constexpr double kSideFilter = gamma_bound(6);

int sign(double value) {
  return (value > 0) - (value < 0);
}

}  // namespace

double difference_of_products(double a, double b, double c, double d) {
  const DoubleDouble left = exact_product(a, b), right = exact_product(c, d);
  return (left.high - right.high) + (left.low - right.low);
}

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double value = left - right;
  if (std::abs(value) > kOrientationFilter * (std::abs(left) + std::abs(right))) return sign(value);
  const Expansion ax = exact_difference(a.x(), c.x()), ay = exact_difference(a.y(), c.y());
  const Expansion bx = exact_difference(b.x(), c.x()), by = exact_difference(b.y(), c.y());
  return (ax * by - ay * bx).sign();
}

bool segments_meet(const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& s) {
  const int r_side = orientation(p, q, r), s_side = orientation(p, q, s);
  const int p_side = orientation(r, s, p), q_side = orientation(r, s, q);
  if (r_side * s_side > 0 || p_side * q_side > 0) return false;
  if (r_side != 0 || s_side != 0 || p_side != 0 || q_side != 0) return true;
  const auto apart = [](double a, double b, double c, double d) {
    return std::max(a, b) < std::min(c, d) || std::max(c, d) < std::min(a, b);
  };
  return !apart(p.x(), q.x(), r.x(), s.x()) && !apart(p.y(), q.y(), r.y(), s.y());
}

int side(const Vec3& point, const Plane& plane) {
  const double x = plane.normal.x() * (point.x() - plane.point.x());
  const double y = plane.normal.y() * (point.y() - plane.point.y());
  const double z = plane.normal.z() * (point.z() - plane.point.z());
  const double value = x + y + z;
  if (std::abs(value) > kSideFilter * (std::abs(x) + std::abs(y) + std::abs(z))) return sign(value);
  const DoubleDouble3 d = exact_difference(point, plane.point);
  return (Expansion(d.x) * plane.normal.x() + Expansion(d.y) * plane.normal.y() + Expansion(d.z) * plane.normal.z())
      .sign();
}

}  // namespace etendue
