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

Height height_above(const Boundary& boundary, const Vec3& point) {
  double size = point.cwiseAbs().maxCoeff();
  for (const Vec3& v : boundary.front()) size = std::max(size, v.cwiseAbs().maxCoeff());
  const double scale = std::ldexp(1.0, -std::ilogb(size));
  const SharpPlane plane(localised(boundary.front(), Vec3::Zero(), scale));
  double flatness = plane.flatness();
  for (std::size_t i = 1; i < boundary.size(); ++i) {
    for (const Vec3& v : boundary[i]) flatness = std::max(flatness, std::abs(plane.height(scale * v)));
  }
  return {plane.height(scale * point), flatness};
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
  return point_to_boundary(point, normal, {polygon.vertices()});
}

Bounded point_to_boundary(const Vec3& point, const Vec3& normal, const Boundary& boundary) {
  require(point.allFinite(), "point_to_polygon: the point is finite");
  require(std::abs(normal.squaredNorm() - 1) <= 2 * kUnitSlack, "point_to_polygon: normal is a unit vector");
  const Height height = height_above(boundary, point);
  if (height.value + height.unflat <= 0) return {0, 0};

  const Vec3 unit = normal.normalized();
  Bounded sum;
  for (const std::vector<Vec3>& loop : boundary) {
    const std::vector<Vec3> seen = seen_from(point, loop);
    std::vector<double> heights;
    heights.reserve(seen.size());
    bool behind = false;
    for (const Vec3& v : seen) {
      heights.push_back(v.dot(unit));
      behind = behind || heights.back() < 0;
    }
    const Bounded part = behind ? lambert_sum(clip(seen, heights), unit) : lambert_sum(seen, unit);
    sum = {sum.value + part.value, sum.bound + part.bound};
  }
  // In front or behind, the vertices' distances from their plane decide it: 0, or what the outline spans.
  if (height.value <= height.unflat) return {0, std::min(1.0, std::abs(sum.value) + sum.bound)};
  // 0 ≤ F ≤ 1 holds for the truth: moving the value into the range by at most its error only brings it nearer.
  return {std::clamp(sum.value, 0.0, 1.0), std::min(sum.bound, 1.0)};
}

}  // namespace etendue
