// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/point_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/loop.hpp"
#include "etendue/form_factor/sharp_plane.hpp"

namespace etendue {

namespace {

/// How far a caller's unit vector may be from length one: a few roundings of a normalisation.
constexpr double kUnitSlack = 16 * kUnitRoundoff;

std::vector<Vec3> seen_from(const Vec3& point, const std::vector<Vec3>& vertices) {
  std::vector<Vec3> seen;
  seen.reserve(vertices.size());
  for (const Vec3& v : vertices) seen.push_back(v - point);
  return seen;
}

struct Height {
  double value;   ///< of the point above the polygon's plane; the sign is exact
  double unflat;  ///< largest distance of a vertex from that plane
};

Height height_above(const Polygon& polygon, const Vec3& point) {
  double size = point.cwiseAbs().maxCoeff();
  for (const Vec3& v : polygon.vertices()) size = std::max(size, v.cwiseAbs().maxCoeff());
  const double scale = std::ldexp(1.0, -std::ilogb(size));
  std::vector<Vec3> vertices;
  vertices.reserve(polygon.vertices().size());
  for (const Vec3& v : polygon.vertices()) vertices.push_back(scale * v);
  const SharpPlane plane(vertices);
  return {plane.height(scale * point), plane.flatness()};
}

}  // namespace

Bounded lambert_sum(std::span<const Vec3> seen, const Vec3& normal) {
  constexpr double kPerTurn = 0.5 / std::numbers::pi;
  constexpr int kAngleRoundings = 12;  // atan2 of two products, the division, the product, the sum; the unit normal
  constexpr int kCrossRoundings = 4;   // each component of a × b errs by 3u |a||b|
  double sum = 0, error = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec3& a = seen[i];
    const Vec3& b = seen[i + 1 < seen.size() ? i + 1 : 0];
    // The edge times the nearer end: smaller factors, smaller rounding than a × b.
    const double aa = a.squaredNorm(), bb = b.squaredNorm();
    const Vec3 edge = b - a;
    const Vec3 across = edge.cross(aa < bb ? a : b);  // b × a
    const double size = across.norm();
    if (!(size > 0)) continue;
    const double angle = std::atan2(size, a.dot(b));
    sum += angle * across.dot(normal) / size;
    error += angle * (kAngleRoundings + kCrossRoundings * std::sqrt(std::min(aa, bb)) * edge.norm() / size);
  }
  return {kPerTurn * sum, kPerTurn * kUnitRoundoff * error};
}

Bounded point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon) {
  require(point.allFinite(), "point_to_polygon: the point is finite");
  require(std::abs(normal.squaredNorm() - 1) <= 2 * kUnitSlack, "point_to_polygon: normal is a unit vector");
  const Height height = height_above(polygon, point);
  if (height.value + height.unflat <= 0) return {0, 0};

  const Vec3 unit = normal.normalized();
  const std::vector<Vec3> seen = seen_from(point, polygon.vertices());
  std::vector<double> heights;
  heights.reserve(seen.size());
  bool behind = false;
  for (const Vec3& v : seen) {
    heights.push_back(v.dot(unit));
    behind = behind || heights.back() < 0;
  }
  const Bounded sum = behind ? lambert_sum(clip(seen, heights), unit) : lambert_sum(seen, unit);
  // In front or behind, the vertices' distances from their plane decide it: 0, or what the outline spans.
  if (height.value <= height.unflat) return {0, std::min(1.0, std::abs(sum.value) + sum.bound)};
  // 0 ≤ F ≤ 1 holds for the truth: moving the value into the range by at most its error only brings it nearer.
  return {std::clamp(sum.value, 0.0, 1.0), std::min(sum.bound, 1.0)};
}

}  // namespace etendue
