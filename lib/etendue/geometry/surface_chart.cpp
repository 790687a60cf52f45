// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/surface_chart.hpp"

#include <cmath>
#include <numbers>

#include "etendue/geometry/meeting.hpp"

namespace etendue {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double share_of_turn(double sine, double cosine) {
  const double share = std::atan2(sine, cosine) / kTurn;
  const double positive = share < 0 ? share + 1 : share;
  return positive < 1 ? positive : 0;  // −1e-20 + 1 rounds to 1
}

/// The half-plane of a point about an axis, and how far around and out it is.
struct Meridian {
  double u;            // share of a turn
  double out;          // distance from the axis
  Vec3 radial, along;  // unit vectors: away from the axis, and the way in which u grows

  Meridian(const Vec3& axis, const TangentFrame& frame, const Vec3& from_axis) {
    const double x = frame.u.dot(from_axis), y = frame.v.dot(from_axis);
    u = share_of_turn(y, x);
    out = std::hypot(x, y);
    radial = out > 0 ? Vec3((x * frame.u + y * frame.v) / out) : frame.u;
    along = axis.cross(radial);
  }
};

ChartPoint wall(const Vec3& base, const Vec3& top, double base_radius, double top_radius, const Vec3& point) {
  const Vec3 height = top - base;
  const Vec3 axis = height.normalized();
  const Meridian at(axis, tangent_frame(axis), point - base);
  const double v = (point - base).dot(height) / height.squaredNorm();
  const double growth = top_radius - base_radius;
  return {at.u, v, kTurn * (base_radius + v * growth) * at.along, height + growth * at.radial};
}

}  // namespace

ChartPoint chart(const Sphere& sphere, const Vec3& point) {
  const Vec3 from_centre = point - sphere.centre;
  const Meridian at(Vec3::UnitZ(), {Vec3::UnitX(), Vec3::UnitY()}, from_centre);
  const double rise = std::atan2(at.out, -from_centre.z());
  return {at.u, rise / std::numbers::pi, kTurn * sphere.radius * std::sin(rise) * at.along,
          std::numbers::pi * sphere.radius * (std::cos(rise) * at.radial + std::sin(rise) * Vec3::UnitZ())};
}

ChartPoint chart(const Cylinder& cylinder, const Vec3& point) {
  return wall(cylinder.base, cylinder.top, cylinder.radius, cylinder.radius, point);
}

ChartPoint chart(const Cone& cone, const Vec3& point) {
  return wall(cone.base, cone.top, cone.base_radius, cone.top_radius, point);
}

ChartPoint chart(const Torus& torus, const Vec3& point) {
  const Vec3 axis = torus.axis.normalized();
  const Vec3 from_centre = point - torus.centre;
  const Meridian at(axis, tangent_frame(axis), from_centre);
  const double outward = at.out - torus.ring, upward = axis.dot(from_centre);
  const double length = std::hypot(outward, upward);
  const double cosine = length > 0 ? outward / length : 1, sine = length > 0 ? upward / length : 0;
  return {at.u, share_of_turn(sine, cosine), kTurn * (torus.ring + torus.tube * cosine) * at.along,
          kTurn * torus.tube * (cosine * axis - sine * at.radial)};
}

}  // namespace etendue
