// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/sight_zone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "etendue/form_factor/frame_plane.hpp"
#include "etendue/form_factor/view_side.hpp"

namespace etendue {

namespace {

SourceFrame frame_of(const FacingPair& pair, const Vec3& from_origin) {
  const std::vector<Vec3>& v = pair.from.vertices;
  SourceFrame frame;
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
  bool in_front = true;              ///< no point behind either plane
  std::vector<FramePlane> planes{};  ///< of a solid's faces; of a plate one, which all its pieces share
  std::vector<bool> flush{};  ///< whether that plane is the source's: such a face is seen from none of its points
};

void find_planes(Placed& placed, const FramePlane& source, const Meant& meant) {
  placed.planes.reserve(placed.blocker->is_solid() ? placed.blocker->faces().size() : 1);
  for (const Blocker::Face& face : placed.blocker->faces()) {
    const std::vector<std::size_t>& c = face.corners;
    const Vec3& base = placed.points[c[0]];
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < c.size(); ++i) {
      normal += (placed.points[c[i]] - base).cross(placed.points[c[i + 1]] - base);
    }
    placed.planes.push_back({normal.normalized(), base, 0});
    placed.flush.push_back(
        std::all_of(c.begin(), c.end(), [&](std::size_t i) { return meant.on(source, placed.points[i]); }));
    if (!placed.blocker->is_solid()) return;
  }
}

template <typename Points>
std::vector<double> heights_of(const Points& points, const FramePlane& plane) {
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const auto& p : points) heights.push_back(plane.height(p));
  return heights;
}

Outline cut(const Outline& loop, const std::vector<double>& heights) {
  Outline kept;
  kept.reserve(loop.size() + 1);  // a convex loop gains one corner
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
    const SidesOf sides(loop, *plane);
    if (!sides.front) return {};
    if (sides.behind) loop = cut(loop, heights_of(loop, *plane));
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
  loop.reserve(edges);
  for (std::size_t p = start; p < next.size() && loop.size() < edges; p = next[p]) loop.push_back(p);
  return loop;
}

/// A zone lies on one side of every plane that it was cut by; its own corners do only but for their rounding. So the corner
/// farthest from the plane tells.
double height_of(const std::vector<Vec2>& zone, const FramePlane& plane) {
  double farthest = 0;
  for (const Vec2& corner : zone) {
    const double height = plane.height(corner);
    if (std::abs(height) > std::abs(farthest)) farthest = height;
  }
  return farthest;
}

class Zoning {
 public:
  Zoning(std::vector<Placed> placed, FramePlane source, FramePlane receiver)
      : placed_(std::move(placed)), source_(std::move(source)), receiver_(std::move(receiver)) {}

  /// Cuts the convex `corners` by the planes of plates and faces that cross them.
  void divide(std::vector<Vec2> corners, std::vector<SightZone>& zones) const {
    std::vector<std::vector<Vec2>> parts{std::move(corners)};
    for (const Placed& p : placed_) {
      for (const FramePlane& plane : p.planes) {
        for (std::size_t k = parts.size(); k > 0; --k) split(parts, k - 1, plane);
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
  /// Leaves the part in front of the plane, and adds what lies behind.
  static void split(std::vector<std::vector<Vec2>>& parts, std::size_t index, const FramePlane& plane) {
    const SidesOf sides(parts[index], plane);
    if (!sides.front || !sides.behind) return;
    const std::vector<Vec2> whole = std::move(parts[index]);
    std::vector<double> heights = heights_of(whole, plane);
    std::array<std::vector<Vec2>, 2> kept;
    for (std::vector<Vec2>& part : kept) {
      for (std::size_t i = 0; i < whole.size(); ++i) {
        const std::size_t j = (i + 1) % whole.size();
        if (heights[i] >= 0) part.push_back(whole[i]);
        if ((heights[i] > 0 && heights[j] < 0) || (heights[i] < 0 && heights[j] > 0)) {
          part.push_back(whole[i] + heights[i] / (heights[i] - heights[j]) * (whole[j] - whole[i]));
        }
      }
      for (double& h : heights) h = -h;
    }
    // Of a convex part either side has three corners: one beyond the plane, two on it.
    parts[index] = std::move(kept[0]);
    parts.push_back(std::move(kept[1]));
  }

  void add(Outline loop, SightZone& zone) const {
    loop = keep_between(std::move(loop), source_, receiver_);
    if (!loop.empty()) zone.outlines.push_back(std::move(loop));
  }

  static Outline loop_of(const Placed& p, const std::vector<std::size_t>& corners, bool reversed) {
    Outline loop;
    loop.reserve(corners.size());
    for (const std::size_t c : corners) loop.push_back(p.points[c]);
    if (reversed) std::reverse(loop.begin(), loop.end());
    return loop;
  }

  void add_plates(const Placed& p, SightZone& zone) const {
    const double height = height_of(zone.corners, p.planes.front());
    if (p.flush.front() || height == 0) return;  // the zone lies in the plate's plane
    if (height < 0 && p.blocker->sides() == BlockingSides::front) return;
    for (const Blocker::Face& face : p.blocker->faces()) add(loop_of(p, face.corners, height > 0), zone);
  }

  void add_solid(const Placed& p, SightZone& zone) const {
    std::vector<bool> seen;
    seen.reserve(p.planes.size());
    bool any = false;
    for (std::size_t f = 0; f < p.planes.size(); ++f) {
      seen.push_back(!p.flush[f] && height_of(zone.corners, p.planes[f]) > 0);
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
  const SidesOf by_source(points, source), by_receiver(points, receiver);
  if (!by_source.front || !by_receiver.front) return Place::behind;
  return by_source.behind || by_receiver.behind ? Place::across : Place::in_front;
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

/// Whether the receiver lies outside of one edge of the outline, from all of the zone: then nothing of it is hidden.
bool misses(const Outline& outline, std::span<const Vec3> receiver, std::span<const Vec2> zone) {
  for (std::size_t j = 0; j < outline.size(); ++j) {
    const Vec3 &a = outline[j], &b = outline[j + 1 < outline.size() ? j + 1 : 0];
    const auto outside = [&](const Vec3& corner) {
      const ViewSide side = view_side(a, b, corner);
      return std::all_of(zone.begin(), zone.end(), [&](const Vec2& x) { return side.at(x) <= 0; });
    };
    if (std::all_of(receiver.begin(), receiver.end(), outside)) return true;
  }
  return false;
}

/// The least a polygon may be wide that has this area and diameter.
double width_of(const std::vector<Vec3>& corners) {
  double area = 0, longest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    longest = std::max(longest, (a - corners[0]).norm());
  }
  return std::abs(area) / longest;
}

}  // namespace

SightSpace sight_space(const FacingPair& pair, const Vec3& from_origin, std::span<const Blocker* const> blockers) {
  const SourceFrame frame = frame_of(pair, from_origin);
  SightSpace space;
  std::vector<Vec3> source;
  source.reserve(pair.from.vertices.size());
  space.receiver.reserve(pair.to.vertices.size());
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
  const Meant meant{kMeantOnPlane * pair.scale * from_origin.cwiseAbs().sum(), width_of(source)};
  std::vector<Placed> placed;
  placed.reserve(blockers.size());
  for (const Blocker* blocker : blockers) {
    Placed candidate{blocker, frame.placed(blocker->points())};
    const Place where = place(candidate.points, source_plane, receiver_plane);
    if (where == Place::behind || apart(candidate.points, low, high)) continue;
    candidate.in_front = where == Place::in_front;
    find_planes(candidate, source_plane, meant);
    placed.push_back(std::move(candidate));
  }
  const Zoning zoning(std::move(placed), source_plane, receiver_plane);
  for (const std::vector<std::size_t>& piece : convex_pieces(source, Vec3::UnitZ())) {
    std::vector<Vec2> corners;
    corners.reserve(piece.size());
    for (const std::size_t i : piece) corners.push_back(source[i].head<2>());
    zoning.divide(std::move(corners), space.zones);
  }
  for (SightZone& zone : space.zones) {
    std::erase_if(zone.outlines, [&](const Outline& outline) { return misses(outline, space.receiver, zone.corners); });
  }
  return space;
}

SightSpace sight_space(const Vec3& point, const Vec3& normal, const Polygon& to,
                       std::span<const Blocker* const> blockers) {
  const PointFrame own = frame_of(point, normal);
  const SourceFrame frame{own.x, own.y, own.z, own.origin, 1};
  const Outline receiver = frame.placed(to.vertices());
  const FramePlane horizon{Vec3::UnitZ(), Vec3::Zero(), 0};
  const FramePlane receiver_plane{frame.turned(to.normal()), receiver[0], 0};
  SightSpace space;
  space.receiver = cut(receiver, heights_of(receiver, horizon));
  const Meant meant{kMeantOnPlane * own.origin.cwiseAbs().sum()};
  std::vector<Placed> placed;
  for (const Blocker* blocker : blockers) {
    Placed candidate{blocker, frame.placed(blocker->points())};
    const Place where = place(candidate.points, horizon, receiver_plane);
    if (where == Place::behind) continue;
    candidate.in_front = where == Place::in_front;
    find_planes(candidate, horizon, meant);
    placed.push_back(std::move(candidate));
  }
  space.zones.push_back(Zoning(std::move(placed), horizon, receiver_plane).zone({Vec2::Zero()}));
  return space;
}

PointFrame frame_of(const Vec3& point, const Vec3& normal) {
  return {normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal()), normal, point};
}

std::vector<std::vector<Outline>> point_outlines(const PointFrame& own, std::span<const Blocker* const> blockers) {
  const SourceFrame frame{own.x, own.y, own.z, own.origin, 1};
  const FramePlane horizon{Vec3::UnitZ(), Vec3::Zero(), 0};
  std::vector<std::vector<Outline>> found;
  for (const Blocker* blocker : blockers) {
    Placed placed{blocker, frame.placed(blocker->points())};
    const Place where = place(placed.points, horizon, horizon);
    found.emplace_back();
    if (where == Place::behind) continue;
    placed.in_front = where == Place::in_front;
    find_planes(placed, horizon, {kMeantOnPlane * own.origin.cwiseAbs().sum()});
    found.back() = Zoning({std::move(placed)}, horizon, horizon).zone({Vec2::Zero()}).outlines;
  }
  return found;
}

}  // namespace etendue
