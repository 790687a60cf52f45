// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/blocker.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// A solid whose corners leave its faces' planes by less than this share of its extent and largest coordinate is
/// convex: what rounding the corners of a box does to it, with room to spare. Its shadow then errs by as much.
constexpr double kConvexity = 64 * kUnitRoundoff;

double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  return (b - a).cross(c - b).dot(normal);
}

/// Whether the triangle a b c, an ear's candidate, holds p, its outline included.
bool holds(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, const Vec3& normal) {
  return turn(a, b, p, normal) >= 0 && turn(b, c, p, normal) >= 0 && turn(c, a, p, normal) >= 0;
}

std::size_t index_of(std::vector<Vec3>& points, const Vec3& point) {
  const auto found = std::find(points.begin(), points.end(), point);
  if (found != points.end()) return static_cast<std::size_t>(found - points.begin());
  points.push_back(point);
  return points.size() - 1;
}

}  // namespace

std::vector<std::vector<std::size_t>> convex_pieces(std::span<const Vec3> corners, const Vec3& normal) {
  std::vector<std::size_t> left(corners.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  const auto corner = [&](std::size_t k) -> const Vec3& { return corners[left[k % left.size()]]; };
  bool convex = true;
  for (std::size_t k = 0; k < left.size(); ++k) {
    convex = convex && turn(corner(k), corner(k + 1), corner(k + 2), normal) >= 0;
  }
  if (convex) return {left};
  std::vector<std::vector<std::size_t>> pieces;
  while (left.size() > 3) {
    std::size_t ear = left.size();
    for (std::size_t k = 0; k < left.size() && ear == left.size(); ++k) {
      if (turn(corner(k), corner(k + 1), corner(k + 2), normal) <= 0) continue;
      bool free = true;
      for (std::size_t other = 3; other < left.size() && free; ++other) {
        free = !holds(corner(k), corner(k + 1), corner(k + 2), corner(k + other), normal);
      }
      if (free) ear = k;
    }
    // A simple polygon has an ear; where rounding hides it, any corner goes on.
    if (ear == left.size()) ear = 0;
    const std::size_t n = left.size();
    pieces.push_back({left[ear], left[(ear + 1) % n], left[(ear + 2) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>((ear + 1) % n));
  }
  pieces.push_back(left);
  return pieces;
}

Blocker Blocker::plate(const Polygon& polygon, BlockingSides sides) {
  Blocker blocker;
  blocker.points_ = polygon.vertices();
  blocker.sides_ = sides;
  for (std::vector<std::size_t>& piece : convex_pieces(blocker.points_, polygon.normal())) {
    blocker.faces_.push_back({std::move(piece), polygon.normal()});
  }
  return blocker;
}

std::optional<Blocker> Blocker::solid(std::span<const Polygon> faces) {
  if (faces.size() < 4) return std::nullopt;
  Blocker blocker;
  for (const Polygon& polygon : faces) {
    Face face{{}, polygon.normal()};
    for (const Vec3& v : polygon.vertices()) face.corners.push_back(index_of(blocker.points_, v));
    blocker.faces_.push_back(std::move(face));
  }
  double extent = 0, largest = 0;
  for (const Vec3& p : blocker.points_) {
    extent = std::max(extent, (p - blocker.points_[0]).norm());
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  for (const Face& face : blocker.faces_) {
    for (const Vec3& p : blocker.points_) {
      const double height = face.normal.dot(p - blocker.points_[face.corners[0]]);
      if (height > kConvexity * (extent + largest)) return std::nullopt;
    }
  }
  struct Half {
    std::size_t start, end, face;
    bool operator==(const Half& other) const { return start == other.start && end == other.end; }
  };
  std::vector<Half> halves;
  for (std::size_t f = 0; f < blocker.faces_.size(); ++f) {
    const std::vector<std::size_t>& c = blocker.faces_[f].corners;
    for (std::size_t k = 0; k < c.size(); ++k) halves.push_back({c[k], c[(k + 1) % c.size()], f});
  }
  for (const Half& half : halves) {
    if (std::count(halves.begin(), halves.end(), half) != 1) return std::nullopt;
    const auto twin = std::find(halves.begin(), halves.end(), Half{half.end, half.start, 0});
    if (twin == halves.end()) return std::nullopt;
    if (half.start < half.end) blocker.edges_.push_back({half.start, half.end, half.face, twin->face});
  }
  return blocker;
}

}  // namespace etendue
