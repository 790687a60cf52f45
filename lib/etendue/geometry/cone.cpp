// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/cone.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/curved_meeting.hpp"

namespace etendue {

namespace {

// Share of the terms' size that each coefficient loses: at most 24 operations of 2^-102 each, NOTES.md §10.
constexpr double kLoss = 0x1p-97;

/// A line that passes an apex at no more than this share of the cone's size passes through it.
constexpr double kThroughApex = 0x1p-90;

/// A cone, counted from its apex where it has one, and what every ray needs of it.
struct Frame {
  Vec3 origin;            // the end from which heights count
  double radius;          // R₀ there
  bool turned;            // that end is the cone's top
  DoubleDouble3 axis;     // A, to the other end
  DoubleDouble n2;        // |A|²
  DoubleDouble widening;  // R₁ − R₀
  double length, reach;   // |A|; no point of the wall is farther from the origin
};

Frame frame_of(const Cone& cone) {
  const bool turned = cone.top_radius == 0;
  const Vec3 &from = turned ? cone.top : cone.base, &to = turned ? cone.base : cone.top;
  const double near = turned ? cone.top_radius : cone.base_radius, far = turned ? cone.base_radius : cone.top_radius;
  Frame frame{from, near, turned, exact_difference(to, from), {}, exact_difference(far, near), 0, 0};
  frame.n2 = dot(frame.axis, frame.axis);
  frame.length = std::sqrt(frame.n2.high);
  frame.reach = frame.length + std::max(near, far);
  return frame;
}

/// |A|⁴ |x|² − |A|² (A·x)² − (R₀ |A|² + (R₁ − R₀) A·x)² as a polynomial in s: negative inside.
BoundedPolynomial quadratic(const NearLine& line, const Vec3& direction, const Frame& frame) {
  const DoubleDouble3 d = widened(direction);
  const DoubleDouble a = dot(d, d), b = dot(line.start, d), square = dot(line.start, line.start);
  const DoubleDouble along = dot(frame.axis, d), height = dot(line.start, frame.axis);
  const DoubleDouble radius = frame.n2 * frame.radius + frame.widening * height, grows = frame.widening * along;
  BoundedPolynomial p;
  p.coefficient[0] = frame.n2 * (frame.n2 * square - height * height) - radius * radius;
  p.coefficient[1] = (frame.n2 * (frame.n2 * b - along * height) - radius * grows) * 2.0;
  p.coefficient[2] = frame.n2 * (frame.n2 * a - along * along) - grows * grows;
  // Every term of coefficient k is at most |A|⁴ |D|^k (|start| + reach)^(2−k) (1 + (reach/|A|)²).
  const double size = line.distance + frame.reach, speed = direction.norm();
  const double steep = 1 + frame.reach * frame.reach / frame.n2.high;
  const double share = 16 * steep * (kLoss + 4 * line.start_error / size) * frame.n2.high * frame.n2.high;
  p.error = {share * size * size, share * size * speed, share * speed * speed, 0, 0};
  return p;
}

/// The apex, where the line passes through it: there the polynomial only touches zero.
std::optional<CurvedMeeting> meeting_at_apex(const Ray& ray, const NearLine& line, const Frame& frame) {
  if (frame.radius > 0) return std::nullopt;
  const DoubleDouble3 d = widened(ray.direction), moment = cross(line.start, d);
  const double aside = Vec3(moment.x.high, moment.y.high, moment.z.high).norm() / ray.direction.norm();
  if (aside > kThroughApex * frame.reach) return std::nullopt;
  const double t = rounded(DoubleDouble(line.shift) - dot(line.start, d) / dot(d, d));
  if (!looks_at(ray, t)) return std::nullopt;
  return CurvedMeeting{t, Vec3::Zero(), aside + 2 * line.start_error};
}

Hit hit_at(const CurvedMeeting& met, const Frame& frame) {
  const Vec3 axis = Vec3(frame.axis.x.high, frame.axis.y.high, frame.axis.z.high).stableNormalized();
  const double height = axis.dot(met.place), slope = frame.widening.high / frame.length;
  const Vec3 across = met.place - height * axis;
  const double radius = across.norm();
  const Vec3 radial = radius > 0 ? Vec3(across / radius) : Vec3::Zero();
  Hit hit;
  hit.t = met.t;
  hit.point = frame.origin + met.place;
  hit.normal = (radial - slope * axis).normalized();  // at an apex the slope is not zero
  hit.point_error = met.place_error + kUnitRoundoff * hit.point.lpNorm<1>();
  hit.surface_error = hit.point_error;
  const TangentFrame tangent = tangent_frame(frame.turned ? Vec3(-axis) : axis);
  const double v = std::clamp(height / frame.length, 0.0, 1.0);
  hit.uv = {turn_of(tangent.u.dot(radial), tangent.v.dot(radial)), frame.turned ? 1 - v : v};
  return hit;
}

}  // namespace

std::optional<Hit> intersect(const Ray& ray, const Cone& cone) {
  require_direction(ray);
  require(cone.base_radius >= 0 && cone.top_radius >= 0 && cone.base_radius + cone.top_radius > 0 &&
              std::isfinite(cone.base_radius + cone.top_radius),
          "intersect: the cone's radii are finite and not negative, one of them positive");
  require(cone.base.allFinite() && cone.top.allFinite() && cone.base != cone.top,
          "intersect: the cone's ends are finite and apart");
  const Frame frame = frame_of(cone);
  const NearLine line(ray, frame.origin);
  if (line.distance * (1 - 0x1p-40) > frame.reach) return std::nullopt;
  const double half = 2 * frame.reach / ray.direction.norm();
  const DoubleDouble start = dot(line.start, frame.axis), speed = dot(frame.axis, ray.direction);
  const auto met =
      first_meeting(ray, line, quadratic(line, ray.direction, frame), {-half, half}, [&](const BoundedZero& zero) {
        const DoubleDouble height = start + zero.x * speed;  // from 0 to |A|²
        return !(height.high < 0) && !(frame.n2 < height);
      });
  const auto apex = meeting_at_apex(ray, line, frame);
  if (apex && (!met || apex->t < met->t)) return hit_at(*apex, frame);
  if (met) return hit_at(*met, frame);
  return std::nullopt;
}

}  // namespace etendue
