// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/sight_zone.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// Rounding of a height: the corners' coordinates, the turn into the source's frame, a dot product; times the distances
/// that enter.
constexpr double kOnPlane = 24 * kUnitRoundoff;

/// A plane as seen in the source's frame.
struct FramePlane {
  Vec3 normal;
  Vec3 point;
  double flatness;

  double height(const Vec3& p) const {
    const double h = normal.dot(p - point);
    return std::abs(h) <= flatness + kOnPlane * (p.norm() + point.norm()) ? 0 : h;
  }
};

struct Frame {
  Vec3 x, y, z;
  Vec3 origin;
  double scale;

  Vec3 turned(const Vec3& v) const { return {x.dot(v), y.dot(v), z.dot(v)}; }
  Vec3 placed(const Vec3& p) const { return turned(scale * (p - origin)); }
};

Frame frame_of(const FacingPair& pair, const Vec3& from_origin) {
  const std::vector<Vec3>& v = pair.from.vertices;
  Frame frame;
  frame.z = pair.from.normal;
  // The longest edge: the turn it gives is the least uncertain.
  std::size_t longest = 0;
  for (std::size_t i = 1; i < v.size(); ++i) {
    if ((v[(i + 1) % v.size()] - v[i]).squaredNorm() > (v[(longest + 1) % v.size()] - v[longest]).squaredNorm()) {
      longest = i;
    }
  }
  const Vec3 edge = v[(longest + 1) % v.size()] - v[longest];
  frame.x = (edge - edge.dot(frame.z) * frame.z).normalized();
  frame.y = frame.z.cross(frame.x);
  frame.origin = from_origin;
  frame.scale = pair.scale;
  return frame;
}

/// A blocker's points in the frame, and what the planes of source and receiver say of them.
struct Placed {
  const Blocker* blocker;
  std::vector<Vec3> points;
  bool in_front;  ///< no point behind either plane
};

Outline cut(const Outline& loop, const std::vector<double>& heights) {
  Outline kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    if (heights[i] >= 0) kept.push_back(loop[i]);
    if ((heights[i] > 0 && heights[j] < 0) || (heights[i] < 0 && heights[j] > 0)) {
      kept.push_back(loop[i] + heights[i] / (heights[i] - heights[j]) * (loop[j] - loop[i]));
    }
  }
  return kept;
}

/// What of the loop lies in front of the source (z > 0) and of the receiver; empty where that is no more than an edge.
Outline keep_between(Outline loop, const FramePlane& source, const FramePlane& receiver) {
  for (const FramePlane* plane : {&source, &receiver}) {
    std::vector<double> heights;
    bool front = false, behind = false;
    for (const Vec3& p : loop) {
      heights.push_back(plane->height(p));
      front = front || heights.back() > 0;
      behind = behind || heights.back() < 0;
    }
    if (!front) return {};
    if (behind) loop = cut(loop, heights);
    if (loop.size() < 3) return {};
  }
  for (Vec3& p : loop) p.z() = source.height(p) == 0 ? 0 : p.z();
  return loop;
}

/// The boundary of the faces that are seen; empty where none is.
std::vector<std::size_t> silhouette(const Blocker& solid, const std::vector<bool>& seen) {
  std::vector<std::size_t> next(solid.points().size(), solid.points().size());
  std::size_t start = solid.points().size(), edges = 0;
  for (const Blocker::Edge& e : solid.edges()) {
    if (seen[e.left] == seen[e.right]) continue;
    // Seen from outside faces run counter-clockwise: the outline wants the other sense.
    const bool turned = seen[e.left];
    next[turned ? e.end : e.start] = turned ? e.start : e.end;
    start = e.start;
    ++edges;
  }
  std::vector<std::size_t> loop;
  for (std::size_t p = start; p < next.size() && loop.size() < edges; p = next[p]) loop.push_back(p);
  return loop;
}

double least_or_most(const std::vector<double>& heights, bool most) {
  return most ? *std::max_element(heights.begin(), heights.end()) : *std::min_element(heights.begin(), heights.end());
}

class Zoning {
 public:
  Zoning(std::vector<Placed> placed, FramePlane source, FramePlane receiver)
      : placed_(std::move(placed)), source_(std::move(source)), receiver_(std::move(receiver)) {}

  /// Cuts the convex `corners` by the planes of plates and faces that cross them.
  void divide(std::vector<Vec2> corners, std::vector<SightZone>& zones) const {
    std::vector<std::vector<Vec2>> parts{std::move(corners)};
    for (const Placed& p : placed_) {
      for (std::size_t f = 0; f < p.blocker->faces().size(); ++f) {
        const FramePlane plane = face_plane(p, f);
        std::vector<std::vector<Vec2>> finer;
        for (std::vector<Vec2>& part : parts) split(std::move(part), plane, finer);
        parts = std::move(finer);
        if (!p.blocker->is_solid()) break;  // all pieces of a plate share its plane
      }
    }
    for (std::vector<Vec2>& part : parts) zones.push_back(zone(std::move(part)));
  }

  SightZone zone(std::vector<Vec2> corners) const {
    SightZone result;
    result.corners = std::move(corners);
    for (const Placed& p : placed_) {
      if (p.blocker->is_solid()) {
        add_solid(p, result);
      } else {
        add_plates(p, result);
      }
    }
    return result;
  }

 private:
  FramePlane face_plane(const Placed& p, std::size_t f) const {
    const std::vector<std::size_t>& c = p.blocker->faces()[f].corners;
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < c.size(); ++i) {
      normal += (p.points[c[i]] - p.points[c[0]]).cross(p.points[c[i + 1]] - p.points[c[0]]);
    }
    return {normal.normalized(), p.points[c[0]], 0};
  }

  static std::vector<double> heights_of(const std::vector<Vec2>& part, const FramePlane& plane) {
    std::vector<double> heights;
    for (const Vec2& v : part) heights.push_back(plane.height({v.x(), v.y(), 0}));
    return heights;
  }

  static void split(std::vector<Vec2> part, const FramePlane& plane, std::vector<std::vector<Vec2>>& out) {
    std::vector<double> heights = heights_of(part, plane);
    if (least_or_most(heights, false) >= 0 || least_or_most(heights, true) <= 0) {
      out.push_back(std::move(part));
      return;
    }
    for (int side = 0; side < 2; ++side) {
      std::vector<Vec2> kept;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const std::size_t j = (i + 1) % part.size();
        if (heights[i] >= 0) kept.push_back(part[i]);
        if ((heights[i] > 0 && heights[j] < 0) || (heights[i] < 0 && heights[j] > 0)) {
          kept.push_back(part[i] + heights[i] / (heights[i] - heights[j]) * (part[j] - part[i]));
        }
      }
      if (kept.size() >= 3) out.push_back(std::move(kept));
      for (double& h : heights) h = -h;
    }
  }

  void add(Outline loop, SightZone& zone) const {
    loop = keep_between(std::move(loop), source_, receiver_);
    if (!loop.empty()) zone.outlines.push_back(std::move(loop));
  }

  static Outline loop_of(const Placed& p, const std::vector<std::size_t>& corners, bool reversed) {
    Outline loop;
    for (const std::size_t c : corners) loop.push_back(p.points[c]);
    if (reversed) std::reverse(loop.begin(), loop.end());
    return loop;
  }

  void add_plates(const Placed& p, SightZone& zone) const {
    const std::vector<double> heights = heights_of(zone.corners, face_plane(p, 0));
    const bool before = least_or_most(heights, true) > 0, behind = least_or_most(heights, false) < 0;
    if (!before && !behind) return;  // the zone lies in the plate's plane
    if (!before && p.blocker->sides() == BlockingSides::front) return;
    for (const Blocker::Face& face : p.blocker->faces()) add(loop_of(p, face.corners, before), zone);
  }

  void add_solid(const Placed& p, SightZone& zone) const {
    std::vector<bool> seen;
    bool any = false;
    for (std::size_t f = 0; f < p.blocker->faces().size(); ++f) {
      seen.push_back(least_or_most(heights_of(zone.corners, face_plane(p, f)), true) > 0);
      any = any || seen.back();
    }
    if (!any) {
      zone.dark = true;
    } else if (p.in_front) {
      add(loop_of(p, silhouette(*p.blocker, seen), false), zone);
    } else {
      // The planes of the pair cut into the solid: what enters it does so through a face that is seen.
      for (std::size_t f = 0; f < seen.size(); ++f) {
        if (seen[f]) add(loop_of(p, p.blocker->faces()[f].corners, true), zone);
      }
    }
  }

  std::vector<Placed> placed_;
  FramePlane source_, receiver_;
};

/// Wholly in front of both planes, wholly behind one of them, or neither.
enum class Place { in_front, behind, across };

Place place(const std::vector<Vec3>& points, const FramePlane& source, const FramePlane& receiver) {
  Place result = Place::in_front;
  for (const FramePlane* plane : {&source, &receiver}) {
    bool front = false, behind = false;
    for (const Vec3& p : points) {
      const double h = plane->height(p);
      front = front || h > 0;
      behind = behind || h < 0;
    }
    if (!front) return Place::behind;
    if (behind) result = Place::across;
  }
  return result;
}

/// Whether a plane across the axes separates the points from the pair's bounds.
bool apart(const std::vector<Vec3>& points, const Vec3& low, const Vec3& high) {
  for (int axis = 0; axis < 3; ++axis) {
    bool below = true, above = true;
    for (const Vec3& p : points) {
      below = below && p(axis) <= low(axis);
      above = above && p(axis) >= high(axis);
    }
    if (below || above) return true;
  }
  return false;
}

}  // namespace

SightSpace sight_space(const FacingPair& pair, const Vec3& from_origin, std::span<const Blocker* const> blockers) {
  const Frame frame = frame_of(pair, from_origin);
  SightSpace space;
  std::vector<Vec3> source;
  for (const Vec3& v : pair.from.vertices) {
    source.push_back(frame.turned(v));
    source.back().z() = 0;
  }
  for (const Vec3& v : pair.to.vertices) space.receiver.push_back(frame.turned(v + pair.offset));
  const FramePlane source_plane{Vec3::UnitZ(), Vec3::Zero(), pair.from.flatness};
  const FramePlane receiver_plane{frame.turned(pair.to.normal), space.receiver[0], pair.to.flatness};
  // What the receiver's own plane makes of the source's corners was decided exactly; only rounding is left here.
  for (Vec3& p : space.receiver) p.z() = std::max(p.z(), 0.0);

  Vec3 low = source[0], high = source[0];
  for (const std::vector<Vec3>* loop : {&source, &space.receiver}) {
    for (const Vec3& p : *loop) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  std::vector<Placed> placed;
  for (const Blocker* blocker : blockers) {
    Placed candidate{blocker, {}, true};
    for (const Vec3& p : blocker->points()) candidate.points.push_back(frame.placed(p));
    const Place where = place(candidate.points, source_plane, receiver_plane);
    if (where == Place::behind || apart(candidate.points, low, high)) continue;
    candidate.in_front = where == Place::in_front;
    placed.push_back(std::move(candidate));
  }
  const Zoning zoning(std::move(placed), source_plane, receiver_plane);
  for (const std::vector<std::size_t>& piece : convex_pieces(source, Vec3::UnitZ())) {
    std::vector<Vec2> corners;
    for (const std::size_t i : piece) corners.push_back(source[i].head<2>());
    zoning.divide(std::move(corners), space.zones);
  }
  return space;
}

SightSpace sight_space(const Vec3& point, const Vec3& normal, const Polygon& to,
                       std::span<const Blocker* const> blockers) {
  const Frame frame{normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal()), normal, point, 1};
  Outline receiver;
  for (const Vec3& v : to.vertices()) receiver.push_back(frame.placed(v));
  const FramePlane horizon{Vec3::UnitZ(), Vec3::Zero(), 0};
  const FramePlane receiver_plane{frame.turned(to.normal()), receiver[0], 0};
  std::vector<double> heights;
  for (const Vec3& v : receiver) heights.push_back(horizon.height(v));
  SightSpace space;
  space.receiver = cut(receiver, heights);
  std::vector<Placed> placed;
  for (const Blocker* blocker : blockers) {
    Placed candidate{blocker, {}, true};
    for (const Vec3& p : blocker->points()) candidate.points.push_back(frame.placed(p));
    const Place where = place(candidate.points, horizon, receiver_plane);
    candidate.in_front = where == Place::in_front;
    if (where != Place::behind) placed.push_back(std::move(candidate));
  }
  space.zones.push_back(Zoning(std::move(placed), horizon, receiver_plane).zone({Vec2::Zero()}));
  return space;
}

}  // namespace etendue
