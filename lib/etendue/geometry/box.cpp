// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/box.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/resolved.hpp"

namespace etendue {

namespace {

// Where the ray enters or leaves the box: through the face whose outward normal is sign · axes.col(axis).
struct Crossing {
  DoubleDouble t;
  int axis = -1;
  double sign = 0;
};

Expansion exact_dot(const DoubleDouble3& a, const Vec3& b) {
  return Expansion(a.x) * b.x() + Expansion(a.y) * b.y() + Expansion(a.z) * b.z();
}

// Cuts the part of the ray between `enter` and `leave` down to the slab along one axis; false where nothing is left.
bool cut(const Ray& ray, const Box& box, int axis, Crossing& enter, Crossing& leave) {
  const Vec3 normal = box.axes.col(axis);
  const double half = box.half_edges[axis];
  const DoubleDouble3 v = exact_difference(ray.origin, box.centre);
  const double height_scale = normal.cwiseProduct(ray.origin - box.centre).lpNorm<1>() + half;
  const DoubleDouble height = dot(v, normal);
  // Heights of the origin above the two faces; exact signs.
  const DoubleDouble above_low = resolved(height + half, height_scale, [&] { return exact_dot(v, normal) + half; });
  const DoubleDouble above_high = resolved(height - half, height_scale, [&] { return exact_dot(v, normal) - half; });
  const DoubleDouble3 direction = widened(ray.direction);
  const DoubleDouble speed = resolved(dot(direction, normal), normal.cwiseProduct(ray.direction).lpNorm<1>(),
                                      [&] { return exact_dot(direction, normal); });
  if (speed.high == 0) return above_low.high >= 0 && above_high.high <= 0;
  const bool rising = speed.high > 0;
  const DoubleDouble first = -(rising ? above_low : above_high) / speed;
  const DoubleDouble last = -(rising ? above_high : above_low) / speed;
  if (enter.axis < 0 || enter.t < first) enter = {first, axis, rising ? -1.0 : 1.0};
  if (leave.axis < 0 || last < leave.t) leave = {last, axis, rising ? 1.0 : -1.0};
  return true;
}

// Plain double, with margins: true only where the line misses the ball around the box.
bool surely_misses(const Ray& ray, const Box& box) {
  const Vec3 v = ray.origin - box.centre;
  const double a = ray.direction.squaredNorm();
  return v.cross(ray.direction).squaredNorm() >
         a * box.half_edges.squaredNorm() * (1 + gamma_bound(32)) + 32 * kUnitRoundoff * a * v.squaredNorm();
}

}  // namespace

std::optional<Hit> intersect(const Ray& ray, const Box& box) {
  require_direction(ray);
  require(box.half_edges.minCoeff() > 0, "intersect: the box's edges are positive");
  require(box.centre.allFinite() && box.axes.allFinite() && box.half_edges.allFinite(), "intersect: the box is finite");
  if (surely_misses(ray, box)) return std::nullopt;
  Crossing enter, leave;
  for (int axis = 0; axis < 3; ++axis) {
    if (!cut(ray, box, axis, enter, leave)) return std::nullopt;
  }
  if (leave.t < enter.t) return std::nullopt;
  const Crossing& met = looks_at(ray, enter.t.high) ? enter : leave;
  if (!looks_at(ray, met.t.high)) return std::nullopt;
  Hit hit = flat_hit(ray, met.t, met.sign * box.axes.col(met.axis));
  const Vec3 offset = hit.point - box.centre;
  const int u = (met.axis + 1) % 3, v = (met.axis + 2) % 3;
  hit.uv = {box.axes.col(u).dot(offset) / box.half_edges[u], box.axes.col(v).dot(offset) / box.half_edges[v]};
  return hit;
}

}  // namespace etendue
