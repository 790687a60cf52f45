// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/critical_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "etendue/form_factor/view_side.hpp"

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Collector {
 public:
  explicit Collector(LoopSides& sides)
      : sides_(sides), zone_(sides.zone()), receiver_(sides.loop(0)), receiver_is_convex_(sides.receiver_is_convex()) {
    lines_.reserve(16);
  }

  /// Between the corners and edges of two loops.
  void add_pair(std::size_t first, std::size_t second) {
    if (first > 0 && second > 0) find_beyond(first, second);
    add_corners(first, second);
    add_corners(second, first);
    add_horizon(sides_.loop(first), sides_.loop(second));
  }

  std::vector<CriticalLine> take() { return std::move(lines_); }

 private:
  /// A corner and the two it is joined to.
  struct Corner {
    Vec3 at, before, after;
  };

  /// What of two outlines is seen beside the receiver only hides nothing of it.
  void find_beyond(std::size_t first, std::size_t second) {
    for (const std::size_t loop : {first, second}) {
      std::vector<std::uint64_t>& beyond = beyond_[loop == first ? 0 : 1];
      beyond.clear();
      for (std::size_t k = 0; k < sides_.loop(loop).size(); ++k) beyond.push_back(sides_.beyond_receiver({loop, k}));
    }
  }

  void add_corners(std::size_t loop, std::size_t other) {
    const std::span<const Vec3> corners = sides_.loop(loop), edges = sides_.loop(other);
    const bool past = loop > 0 && other > 0;
    const std::size_t turn = loop < other ? 0 : 1;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!(corners[i].z() > 0)) continue;
      const std::size_t before = i > 0 ? i - 1 : corners.size() - 1;
      if (past && (beyond_[turn][before] & beyond_[turn][i]) != 0) continue;
      const Corner corner{corners[i], corners[before], corners[i + 1 < corners.size() ? i + 1 : 0]};
      for (std::size_t j = 0; j < edges.size(); ++j) {
        if (sides_.sign({other, j}, loop, i) != 0 || (past && beyond_[1 - turn][j] != 0)) continue;
        add(corner, edges[j], edges[j + 1 < edges.size() ? j + 1 : 0], past);
      }
    }
  }

  void add(const Corner& corner, const Vec3& a, const Vec3& b, bool past) {
    const Vec3 normal = (a - corner.at).cross(b - corner.at);
    const double level = normal.dot(corner.at);
    // Coincident points, and planes that never meet the source's, drop out, too.
    if (!meets_zone(normal.head<2>(), level)) return;
    const double size = normal.head<2>().norm();
    CriticalLine line{normal.head<2>() / size, level / size, kInfinity, -kInfinity};
    extend(line, corner.at, a, b);
    extend(line, corner.at, b, a);
    if (past && receiver_is_convex_) clip_past(line, corner, normal);
    keep(line);
  }

  /// Takes in where the lines through the corner and the points of the edge near its end `a` come down to the source.
  static void extend(CriticalLine& line, const Vec3& corner, const Vec3& a, const Vec3& b) {
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

  LoopSides& sides_;
  const SightZone& zone_;
  std::span<const Vec3> receiver_;
  bool receiver_is_convex_;
  std::array<std::vector<std::uint64_t>, 2> beyond_;  ///< of the edges of the two loops, the lower one first
  std::vector<CriticalLine> lines_;
};

}  // namespace

std::vector<CriticalLine> critical_lines(LoopSides& sides) {
  Collector collector(sides);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    collector.add_pair(0, i);
    for (std::size_t j = 1; j < i; ++j) {
      if (!sides.apart(j, i)) collector.add_pair(j, i);
    }
  }
  return collector.take();
}

std::vector<CriticalLine> critical_lines(std::span<const Vec3> receiver, const SightZone& zone) {
  LoopSides sides(receiver, zone);
  return critical_lines(sides);
}

}  // namespace etendue
