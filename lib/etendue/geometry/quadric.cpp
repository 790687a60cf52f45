// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/quadric.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/curved_meeting.hpp"

namespace etendue {

namespace {

// Share of the terms' size that each coefficient loses: at most 24 operations of 2^-102 each, NOTES.md §10.
constexpr double kLoss = 0x1p-97;
/// A meeting within this share of the box's size counts as inside: 8 roundings.
constexpr double kBoxEdge = 0x1p-50;

/// Q y with the symmetric part of Q.
DoubleDouble3 times(const Mat3& q, const DoubleDouble3& y) {
  const auto row = [&](Eigen::Index i) {
    const auto entry = [&](Eigen::Index j) { return exact_sum(0.5 * q(i, j), 0.5 * q(j, i)); };
    return entry(0) * y.x + entry(1) * y.y + entry(2) * y.z;
  };
  return {row(0), row(1), row(2)};
}

/// f along the line.
BoundedPolynomial quadratic(const NearLine& line, const Vec3& direction, const Quadric& quadric) {
  const DoubleDouble3 d = widened(direction), linear = widened(quadric.linear);
  const DoubleDouble3 qd = times(quadric.square, d), qy = times(quadric.square, line.start);
  BoundedPolynomial p;
  p.coefficient[0] = dot(line.start, qy) + dot(line.start, linear) * 2.0 + DoubleDouble(quadric.constant);
  p.coefficient[1] = (dot(d, qy) + dot(d, linear)) * 2.0;
  p.coefficient[2] = dot(d, qd);
  const double curved = quadric.square.lpNorm<1>(), sloped = quadric.linear.lpNorm<1>(), speed = direction.norm();
  const double far = line.distance;
  // Rounding of the terms, and what an error of the start does to them.
  p.error = {4 * kLoss * (far * (curved * far + 2 * sloped) + std::abs(quadric.constant)) +
                 4 * line.start_error * (curved * far + sloped + curved * line.start_error),
             8 * speed * (kLoss * (curved * far + sloped) + line.start_error * curved),
             4 * kLoss * curved * speed * speed, 0, 0};
  return p;
}

}  // namespace

std::optional<Hit> intersect(const Ray& ray, const Quadric& quadric) {
  require_direction(ray);
  require(quadric.square.allFinite() && quadric.linear.allFinite() && std::isfinite(quadric.constant),
          "intersect: the quadric's coefficients are finite");
  const Box& box = quadric.box;
  require(box.centre.allFinite() && box.half_edges.allFinite() && (box.half_edges.array() > 0).all(),
          "intersect: the quadric's box is finite, its edges positive");
  const NearLine line(ray, box.centre);
  const double reach = box.half_edges.norm();
  if (line.distance * (1 - 0x1p-40) > reach) return std::nullopt;
  const double half = 2 * reach / ray.direction.norm();
  const auto in_box = [&](const Vec3& place) {
    return (box.axes.transpose() * place).cwiseQuotient(box.half_edges).eval();
  };
  const auto met =
      first_meeting(ray, line, quadratic(line, ray.direction, quadric), {-half, half}, [&](const BoundedZero& zero) {
        return in_box(rounded_along(line.start, zero.x, ray.direction)).lpNorm<Eigen::Infinity>() <= 1 + kBoxEdge;
      });
  if (!met) return std::nullopt;
  Hit hit;
  hit.t = met->t;
  hit.point = box.centre + met->place;
  const Vec3 gradient = 0.5 * (quadric.square + quadric.square.transpose()) * met->place + quadric.linear;
  hit.normal = gradient.squaredNorm() > 0 ? gradient.stableNormalized() : Vec3(-ray.direction.stableNormalized());
  hit.point_error = met->place_error + kUnitRoundoff * hit.point.lpNorm<1>();
  hit.surface_error = hit.point_error;
  hit.uv = in_box(met->place).head<2>().cwiseMin(1).cwiseMax(-1);
  return hit;
}

}  // namespace etendue
