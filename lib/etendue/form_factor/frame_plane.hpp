// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/vector.hpp"

// Planes and points in the frame of a source, for sight_zone.cpp alone.
namespace etendue {

/// Rounding of a height: the corners' coordinates, the turn into the source's frame, a dot product; times the distances
/// that enter.
inline constexpr double kOnPlane = 24 * kUnitRoundoff;

/// Of the coordinates in the scene, for points that are meant to lie in one plane: their rounding.
inline constexpr double kMeantOnPlane = 8 * kUnitRoundoff;

/// A plane as seen in the source's frame.
struct FramePlane {
  Vec3 normal;
  Vec3 point;
  double flatness;

  double height(const Vec3& p) const {
    const double h = normal.dot(p - point), size = std::abs(h);
    if (size > flatness + kOnPlane * (p.cwiseAbs().sum() + point.cwiseAbs().sum())) return h;  // no less than the norms
    return size <= flatness + kOnPlane * (p.norm() + point.norm()) ? 0 : h;
  }
  double height(const Vec2& p) const { return height(Vec3(p.x(), p.y(), 0)); }
};

/// On which sides of a plane some points lie.
struct SidesOf {
  bool front = false, behind = false;
  template <typename Points>
  SidesOf(const Points& points, const FramePlane& plane) {
    for (const auto& p : points) {
      const double h = plane.height(p);
      front = front || h > 0;
      behind = behind || h < 0;
    }
  }
};

struct SourceFrame {
  Vec3 x, y, z;
  Vec3 origin;
  double scale;

  Vec3 turned(const Vec3& v) const { return {x.dot(v), y.dot(v), z.dot(v)}; }
  std::vector<Vec3> placed(const std::vector<Vec3>& points) const {
    std::vector<Vec3> result;
    result.reserve(points.size());
    for (const Vec3& p : points) result.push_back(turned(scale * (p - origin)));
    return result;
  }
};

/// How far a point that is meant to lie in the source's plane may be from it: both are rounded where they stand in the
/// scene, and the source, `width` wide, passes its own on like a lever.
struct Meant {
  double rounding = 0, width = std::numeric_limits<double>::infinity();
  bool on(const FramePlane& source, const Vec3& p) const {
    return source.height(p) == 0 || std::abs(source.height(p)) <= rounding * (1 + p.norm() / width);
  }
};

}  // namespace etendue
