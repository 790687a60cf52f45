// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/critical_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "etendue/form_factor/view_side.hpp"

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Takes in where the lines through the corner and the points of the edge near its end `a` come down to the source.
void extend(CriticalLine& line, const Vec3& corner, const Vec3& a, const Vec3& b) {
  const double rise = a.z() - corner.z(), other = b.z() - corner.z();
  if (rise != 0) {
    const Vec2 down = corner.head<2>() - corner.z() / rise * (a - corner).head<2>();
    line.begin = std::min(line.begin, line.along(down));
    line.end = std::max(line.end, line.along(down));
  }
  if (rise == 0 || rise * other > 0) return;
  // A point of the edge is level with the corner: seen along it the source is infinitely far.
  const Vec3 level = other == rise ? a : Vec3(a + rise / (rise - other) * (b - a));
  const double drift = line.along((level - corner).head<2>());
  const bool to_end = (drift > 0) != (rise > 0);
  if (drift == 0) return;
  (to_end ? line.end : line.begin) = to_end ? kInfinity : -kInfinity;
}

CriticalLine stretch(const Vec3& corner, const Vec3& a, const Vec3& b, const Vec3& normal) {
  const double size = normal.head<2>().norm();
  CriticalLine line{normal.head<2>() / size, normal.dot(corner) / size, kInfinity, -kInfinity};
  extend(line, corner, a, b);
  extend(line, corner, b, a);
  return line;
}

class Collector {
 public:
  Collector(std::span<const Vec3> receiver, const SightZone& zone) : receiver_(receiver), zone_(zone) {
    lines_.reserve(16);
    Vec2 centre = Vec2::Zero();
    for (const Vec2& v : zone.corners) centre += v / static_cast<double>(zone.corners.size());
    for (std::size_t i = 0; i < receiver.size() && receiver_is_convex_; ++i) {
      const ViewSide corner =
          view_side(receiver[i], receiver[(i + 1) % receiver.size()], receiver[(i + 2) % receiver.size()]);
      receiver_is_convex_ = corner.at(centre) <= 0;
    }
  }

  /// Between the corners and edges of two loops; `past` where the line of sight has to go on to the receiver.
  void add_pair(std::span<const Vec3> first, std::span<const Vec3> second, bool past) {
    add_corners(first, second, past);
    add_corners(second, first, past);
    add_horizon(first, second);
  }

  std::vector<CriticalLine> take() { return std::move(lines_); }

 private:
  /// A corner and the two it is joined to.
  struct Corner {
    Vec3 at, before, after;
  };

  void add_corners(std::span<const Vec3> corners, std::span<const Vec3> loop, bool past) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!(corners[i].z() > 0)) continue;
      const Corner corner{corners[i], corners[i > 0 ? i - 1 : corners.size() - 1],
                          corners[i + 1 < corners.size() ? i + 1 : 0]};
      for (std::size_t j = 0; j < loop.size(); ++j) add(corner, loop[j], loop[j + 1 < loop.size() ? j + 1 : 0], past);
    }
  }

  void add(const Corner& corner, const Vec3& a, const Vec3& b, bool past) {
    const Vec3 normal = (a - corner.at).cross(b - corner.at);
    const double level = normal.dot(corner.at);
    // Coincident points, and planes that never meet the source's, drop out, too.
    if (!meets_zone(normal.head<2>(), level)) return;
    CriticalLine line = stretch(corner.at, a, b, normal);
    if (past && receiver_is_convex_) clip_past(line, corner, normal);
    keep(line);
  }

  /// Keeps the stretch from which the corner is seen against the receiver. Where an edge of the corner lies in the plane of
  /// the event, as parallel edges do, the two edges cover one another there at once: then all of the edge counts.
  void clip_past(CriticalLine& line, const Corner& corner, const Vec3& plane) const {
    constexpr double kInPlane = 0x1p-40;  // far above what rounding lifts an edge out of it; a little more is only kept
    const Vec2 foot = line.level * line.normal, direction(-line.normal.y(), line.normal.x());
    const double size = kInPlane * plane.norm();
    std::array<Vec3, 3> points{corner.at};
    std::size_t count = 1;
    for (const Vec3* other : {&corner.before, &corner.after}) {
      const Vec3 edge = *other - corner.at;
      if (std::abs(plane.dot(edge)) <= size * edge.norm()) points[count++] = *other;
    }
    for (std::size_t i = 0; i < receiver_.size(); ++i) {
      double first = kInfinity, last = -kInfinity;
      for (std::size_t k = 0; k < count; ++k) {
        // Seen from the source the receiver runs clockwise: inside, the corner lies on the negative side.
        const ViewSide side = view_side(receiver_[i], receiver_[(i + 1) % receiver_.size()], points[k]);
        const double at_foot = side.at(foot), slope = side.gradient.dot(direction);
        if (slope > 0 || (slope == 0 && at_foot <= 0)) first = -kInfinity;
        if (slope < 0 || (slope == 0 && at_foot <= 0)) last = kInfinity;
        if (slope > 0) last = std::max(last, -at_foot / slope);
        if (slope < 0) first = std::min(first, -at_foot / slope);
      }
      line.begin = std::max(line.begin, first);
      line.end = std::min(line.end, last);
    }
  }

  /// Corners of both loops in the source's plane: seen past one another along their line, outside the two.
  void add_horizon(std::span<const Vec3> first, std::span<const Vec3> second) {
    for (const Vec3& a : first) {
      for (const Vec3& b : second) {
        if (a.z() != 0 || b.z() != 0 || a == b) continue;
        const Vec2 along = (b - a).head<2>().normalized();
        const Vec2 normal(along.y(), -along.x());
        keep({normal, normal.dot(a.head<2>()), -kInfinity, kInfinity});
      }
    }
  }

  bool meets_zone(const Vec2& normal, double level) const {
    bool below = false, above = false;
    for (const Vec2& v : zone_.corners) {
      const double height = normal.dot(v) - level;
      below = below || height < 0;
      above = above || height > 0;
    }
    return below && above;
  }

  void keep(const CriticalLine& line) {
    if (!meets_zone(line.normal, line.level)) return;
    double first = kInfinity, last = -kInfinity;
    for (const Vec2& v : zone_.corners) {
      first = std::min(first, line.along(v));
      last = std::max(last, line.along(v));
    }
    if (line.begin < last && line.end > first && line.begin < line.end) lines_.push_back(line);
  }

  std::span<const Vec3> receiver_;
  const SightZone& zone_;
  bool receiver_is_convex_ = true;
  std::vector<CriticalLine> lines_;
};

}  // namespace

std::optional<CriticalLine> meeting_line(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 normal = (a - corner).cross(b - corner);
  if (!(normal.head<2>().squaredNorm() > 0)) return std::nullopt;
  return stretch(corner, a, b, normal);
}

std::vector<CriticalLine> critical_lines(std::span<const Vec3> receiver, const SightZone& zone) {
  Collector collector(receiver, zone);
  for (std::size_t i = 0; i < zone.outlines.size(); ++i) {
    collector.add_pair(receiver, zone.outlines[i], false);
    for (std::size_t j = 0; j < i; ++j) collector.add_pair(zone.outlines[j], zone.outlines[i], true);
  }
  return collector.take();
}

}  // namespace etendue
