// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/shaft.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

using Points = std::vector<Vec3>;

/// Rounding of a plane test with points of size order one, as a multiple of the reach: differences, cross product, dot.
constexpr double kPlaneTest = 32 * kUnitRoundoff;

struct Range {
  double low = 0;
  double high = 0;
};

Range range(const Points& points, const Vec3& normal, double level) {
  Range r{normal.dot(points[0]) - level, normal.dot(points[0]) - level};
  for (const Vec3& p : points) {
    const double h = normal.dot(p) - level;
    r.low = std::min(r.low, h);
    r.high = std::max(r.high, h);
  }
  return r;
}

/// The part of a convex blocker in front of the plane; parts within rounding of the plane count as on it.
void keep_front(Points& blocker, const Loop& plane, const Vec3& offset) {
  std::vector<double> heights;
  heights.reserve(blocker.size());
  bool in_front = false;
  for (const Vec3& v : blocker) {
    const Vec3 point = v - offset;
    const double height = height_above(plane, point);
    heights.push_back(std::abs(height) <= height_error(plane, point) ? 0 : height);
    in_front = in_front || heights.back() > 0;
  }
  blocker = in_front ? clip(blocker, heights) : Points{};
}

/// The planes through an edge of `a` and a vertex of `b` that carry both on one side, the blocker on the other.
bool separated_by_tangent(const Points& a, const Points& b, const Points& blocker, double margin) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3& start = a[i];
    const Vec3& end = a[(i + 1) % a.size()];
    for (const Vec3& v : b) {
      Vec3 normal = (end - start).cross(v - start);
      const double size = normal.norm();
      if (!(size > 0)) continue;
      normal /= size;
      const double level = normal.dot(v);
      const Range held = range(blocker, normal, level);
      if (held.high > 0 && held.low < 0) continue;
      const double side = held.low >= 0 ? 1 : -1;
      // The plane may cut into the hull by rounding; the blocker then has to stay off by as much.
      const double slack = margin * (1 + 1 / size);
      const Range of_a = range(a, side * normal, side * level), of_b = range(b, side * normal, side * level);
      const double intrusion = std::max(of_a.high, of_b.high);
      if (intrusion > slack) continue;
      if (range(blocker, side * normal, side * level).low >= std::max(intrusion, 0.0)) return true;
    }
  }
  return false;
}

bool misses_hull(const Points& from, const Points& to, const Points& blocker) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 unit = Vec3::Unit(axis);
    const Range a = range(from, unit, 0), b = range(to, unit, 0), c = range(blocker, unit, 0);
    if (c.low >= std::max(a.high, b.high) || c.high <= std::min(a.low, b.low)) return true;
  }
  double reach = 0;
  for (const Vec3& v : to) reach = std::max(reach, v.norm());
  const double margin = kPlaneTest * reach;
  Vec3 normal = (blocker[1] - blocker[0]).cross(blocker[2] - blocker[0]);
  const double size = normal.norm();
  if (size > 0) {
    normal /= size;
    const double level = normal.dot(blocker[0]);
    const Range a = range(from, normal, level), b = range(to, normal, level);
    if ((a.low >= -margin && b.low >= -margin) || (a.high <= margin && b.high <= margin)) return true;
  }
  return separated_by_tangent(from, to, blocker, margin) || separated_by_tangent(to, from, blocker, margin);
}

/// True where every segment between a vertex of `from` and one of `to` crosses the blocker's inside; then all do.
bool covers(const Points& from, const Points& to, const Points& blocker) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < blocker.size(); ++i) {
    normal += (blocker[i] - blocker[0]).cross(blocker[i + 1] - blocker[0]);
  }
  const double size = normal.norm();
  if (!(size > 0)) return false;
  normal /= size;
  const double level = normal.dot(blocker[0]);
  const Range a = range(from, normal, level), b = range(to, normal, level);
  double reach = 0;
  for (const Vec3& v : to) reach = std::max(reach, v.norm());
  const double margin = kPlaneTest * reach;
  double side = 0;
  if (a.high < -margin && b.low > margin) side = 1;
  if (a.low > margin && b.high < -margin) side = -1;
  if (side == 0) return false;
  for (std::size_t i = 0; i < blocker.size(); ++i) {
    const Vec3& start = blocker[i];
    const Vec3& end = blocker[(i + 1) % blocker.size()];
    for (const Vec3& p : from) {
      const Vec3 inward = side * (start - p).cross(end - p);
      for (const Vec3& q : to) {
        if (inward.dot(q - p) <= margin * (end - start).norm()) return false;
      }
    }
  }
  return true;
}

}  // namespace

Shaft shaft(const FacingPair& pair, const Vec3& from_origin, std::span<const Polygon> blockers) {
  Shaft result;
  Points to;
  for (const Vec3& v : pair.to.vertices) to.push_back(v + pair.offset);
  for (const Polygon& polygon : blockers) {
    Points blocker = localised(polygon.vertices(), from_origin, pair.scale);
    keep_front(blocker, pair.from, Vec3::Zero());
    if (!blocker.empty()) keep_front(blocker, pair.to, pair.offset);
    if (blocker.empty() || misses_hull(pair.from.vertices, to, blocker)) continue;
    result.hides_all = result.hides_all || covers(pair.from.vertices, to, blocker);
    result.blockers.push_back(std::move(blocker));
  }
  return result;
}

}  // namespace etendue
