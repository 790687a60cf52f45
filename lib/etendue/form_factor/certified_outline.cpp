// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "etendue/geometry/newell.hpp"

namespace etendue {

namespace {

/// Up to this relative width an interval is as good as the exact height: cuts are then sharp to the last digits.
constexpr double kSharpEnough = 0x1p-40;

Interval enclosed(const DoubleDouble& value, double error) {
  return Interval(value.high) + Interval(value.low) + Interval(-error, error);
}

/// newell_sum() errs by at most 2^-100 n d² (geometry/NOTES.md §6).
double newell_error(const std::vector<Vec3>& vertices) {
  Interval diameter;
  for (const Vec3& v : vertices) diameter = max(diameter, norm(Interval3(v) - Interval3(vertices.front())));
  const Interval square_bound = Interval(4) * square(diameter);  // d is at most twice the reach from one vertex
  return (Interval(0x1p-100) * static_cast<double>(vertices.size()) * square_bound).upper;
}

/// What two enclosures of one number leave.
Interval common(const Interval& a, const Interval& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

Interval3 enclosed_newell(const std::vector<Vec3>& vertices) {
  const DoubleDouble3 sum = newell_sum(vertices);
  const double error = newell_error(vertices);
  // Plain intervals know the zeros of a polygon across an axis, twice the digits know all else.
  Interval3 plain;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const Interval3 base(vertices.front());
    plain = plain + cross(Interval3(vertices[i]) - base, Interval3(vertices[i + 1]) - base);
  }
  return {common(plain.x, enclosed(sum.x, error)), common(plain.y, enclosed(sum.y, error)),
          common(plain.z, enclosed(sum.z, error))};
}

Interval3 between(const Interval3& a, const Interval3& b, const Interval& share) {
  const Interval3 point = a + share * (b - a);
  // The cut lies between the corners, whatever rounding says.
  return {common(point.x, hull(a.x, b.x)), common(point.y, hull(a.y, b.y)), common(point.z, hull(a.z, b.z))};
}

}  // namespace

ExactPlane::ExactPlane(std::vector<Vec3> vertices)
    : vertices_(std::move(vertices)), normal_(enclosed_newell(vertices_)) {}

Interval ExactPlane::height(const Interval3& point) const {
  return dot(normal_, point - Interval3(vertices_.front()));
}

Interval ExactPlane::height(const Vec3& point) const {
  if (point == vertices_.front()) return {};
  const Interval quick = height(Interval3(point));
  return quick.width() <= kSharpEnough * quick.mignitude() ? quick : exact_height(point);
}

Interval ExactPlane::exact_height(const Vec3& point) const {
  const Expansion height = exact_newell_height(vertices_, point);
  if (height.sign() == 0) return {};
  const DoubleDouble value = height.to_double_double();
  const double error = above(kDoubleDoubleError * std::abs(value.high) * 2);
  return enclosed(value, error);
}

EnclosedOutline clipped(const EnclosedOutline& outline, const std::vector<Interval>& heights) {
  EnclosedOutline kept;
  bool in_front = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = (i + 1) % outline.size();
    const Interval &here = heights[i], &there = heights[next];
    in_front = in_front || here.certainly_positive();
    if (!here.certainly_negative()) kept.push_back(outline[i]);
    const bool crosses = (here.certainly_positive() && there.certainly_negative()) ||
                         (here.certainly_negative() && there.certainly_positive());
    if (crosses) kept.push_back(between(outline[i], outline[next], here / (here - there)));
  }
  if (!in_front || kept.size() < 3) kept.clear();
  return kept;
}

std::vector<Vec3> scaled(const std::vector<Vec3>& vertices, double scale) {
  std::vector<Vec3> result;
  result.reserve(vertices.size());
  for (const Vec3& v : vertices) result.push_back(scale * v);
  return result;
}

EnclosedPair enclosed_pair(const Polygon& from, const Polygon& to) {
  double size = 0;
  for (const Polygon* polygon : {&from, &to}) {
    for (const Vec3& v : polygon->vertices()) {
      size = std::max(size, (v - from.vertices().front()).cwiseAbs().maxCoeff());
    }
  }
  EnclosedPair pair;
  pair.scale = std::ldexp(1.0, -std::ilogb(size));
  const std::vector<Vec3> first = scaled(from.vertices(), pair.scale), second = scaled(to.vertices(), pair.scale);
  const ExactPlane first_plane(first), second_plane(second);
  pair.area = Interval(0.5) * norm(first_plane.normal());
  const auto in_front = [](const std::vector<Vec3>& vertices, const ExactPlane& plane) {
    std::vector<Interval> heights;
    for (const Vec3& v : vertices) heights.push_back(plane.height(v));
    return clipped(EnclosedOutline(vertices.begin(), vertices.end()), heights);
  };
  pair.to = in_front(second, first_plane);
  if (!pair.to.empty()) pair.from = in_front(first, second_plane);
  if (pair.from.empty()) pair.to.clear();
  return pair;
}

}  // namespace etendue
