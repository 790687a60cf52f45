// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/patch_chart.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/geometry/meeting.hpp"

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kQuarters = 4;

/// Nearer to a plane than this share of their distance from the origin, things stand on it.
constexpr double kStanding = 0x1p-40;

/// A flat patch in coordinates of its own: `part`, around `origin`.
struct Flat {
  Vec3 origin, normal;
  TangentFrame frame;
  FlatPart part;

  Vec2 in(const Vec3& p) const { return along(p - origin); }
  Vec2 along(const Vec3& way) const { return {way.dot(frame.u), way.dot(frame.v)}; }
  Vec3 out(const Vec2& p) const { return origin + p.x() * frame.u + p.y() * frame.v; }
  std::pair<FlatPart, FlatPart> split(const FlatPart& some, const Plane& plane) const {
    return some.split(along(plane.normal), (plane.point - origin).dot(plane.normal));
  }
};

Flat flat_of(const CurvedPatch& patch) {
  if (const auto* disc = std::get_if<Disc>(&patch)) {
    return {disc->centre, disc->normal, tangent_frame(disc->normal), FlatPart::disc(disc->radius)};
  }
  const auto& polygon = std::get<Polygon>(patch);
  Flat flat{polygon.centroid(), polygon.normal(), tangent_frame(polygon.normal()), {}};
  std::vector<Vec2> corners;
  for (const Vec3& vertex : polygon.vertices()) corners.push_back(flat.in(vertex));
  flat.part = FlatPart::polygon(std::move(corners));
  return flat;
}

/// Cuts off what lies beyond an edge of a convex loop after the other: all that goes to `rest`. What is left is inside.
FlatPart inside_of(FlatPart part, std::span<const Vec2> loop, std::vector<FlatPart>& rest) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 edge = loop[(k + 1) % loop.size()] - loop[k], outward(edge.y(), -edge.x());
    auto [outside, inside] = part.split(outward, outward.dot(loop[k]));
    if (!outside.empty()) rest.push_back(std::move(outside));
    part = std::move(inside);
  }
  return part;
}

std::vector<Vec2> square_around(const FlatCircle& circle) {
  constexpr double kWider = 1.25;  // so that the wedges between circle and square keep a width
  const Vec2 u(kWider * circle.radius, 0), v(0, kWider * circle.radius);
  return {circle.centre - u - v, circle.centre + u - v, circle.centre + u + v, circle.centre - u + v};
}

/// So that no part meets two circles: cut where both are equally far.
std::vector<FlatPart> parted(std::vector<FlatPart> parts, const std::vector<FlatCircle>& circles) {
  for (std::size_t i = 0; i < circles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 way = circles[j].centre - circles[i].centre;
      if (way.isZero(0)) continue;
      const double share = 0.5 * (1 + (circles[i].radius - circles[j].radius) *
                                          (circles[i].radius + circles[j].radius) / way.squaredNorm());
      std::vector<FlatPart> halves;
      for (const FlatPart& part : parts) {
        auto [beyond, before] = part.meets(circles[i]) && part.meets(circles[j])
                                    ? part.split(way, way.dot(circles[i].centre + share * way))
                                    : std::pair(part, FlatPart());
        if (!beyond.empty()) halves.push_back(std::move(beyond));
        if (!before.empty()) halves.push_back(std::move(before));
      }
      parts = std::move(halves);
    }
  }
  return parts;
}

/// A frame with `axis` whose u points as nearly as it can towards `towards`.
TangentFrame frame_towards(const Vec3& axis, const Vec3& towards) {
  const Vec3 across = towards - towards.dot(axis) * axis;
  constexpr double kAlong = 0x1p-20;  // any u will do where there is hardly one
  if (!(across.norm() > kAlong * towards.norm())) return tangent_frame(axis);
  const Vec3 u = across.normalized();
  return {u, axis.cross(u)};
}

}  // namespace

void PatchChart::add(std::span<const Vec3> v, const Vec3& normal, std::vector<PatchChart>& charts) {
  if (v.size() == 4) {
    PatchChart chart(Kind::bilinear);
    chart.a_ = v[0], chart.b_ = v[1], chart.c_ = v[2], chart.d_ = v[3];
    chart.normal_ = normal;
    charts.push_back(chart);
    return;
  }
  for (std::size_t k = 1; k + 1 < v.size(); ++k) {
    PatchChart chart(Kind::fan);
    chart.a_ = v[0], chart.b_ = v[k], chart.c_ = v[k + 1];
    chart.normal_ = normal;
    charts.push_back(chart);
  }
}

std::vector<PatchChart> PatchChart::of_flat(const CurvedPatch& patch, const PatchCuts& cuts) {
  const Flat flat = flat_of(patch);
  std::vector<FlatPart> parts{flat.part};
  for (const Plane& front : cuts.fronts) parts.front() = flat.split(parts.front(), front).first;
  const auto replace_parts = [&parts](const auto& pieces_of) {
    std::vector<FlatPart> rest;
    for (FlatPart& part : parts) pieces_of(std::move(part), rest);
    parts = std::move(rest);
  };
  for (const Plane& parting : cuts.partings) {
    replace_parts([&](const FlatPart& part, std::vector<FlatPart>& rest) {
      auto [beyond, before] = flat.split(part, parting);
      if (!beyond.empty()) rest.push_back(std::move(beyond));
      if (!before.empty()) rest.push_back(std::move(before));
    });
  }
  std::vector<FlatCircle> circles;
  for (const Footprint& footprint : cuts.footprints) {
    if (footprint.loop.empty()) {
      circles.push_back({flat.in(footprint.centre), footprint.radius});
      continue;
    }
    std::vector<Vec2> loop;
    for (const Vec3& corner : footprint.loop) loop.push_back(flat.in(corner));
    replace_parts([&](FlatPart part, std::vector<FlatPart>& rest) { inside_of(std::move(part), loop, rest); });
  }
  std::vector<Wedge> wedges;
  parts = parted(std::move(parts), circles);
  for (const FlatCircle& circle : circles) {
    replace_parts([&](FlatPart part, std::vector<FlatPart>& rest) {
      if (!part.meets(circle)) {
        rest.push_back(std::move(part));
        return;
      }
      const FlatPart near = inside_of(std::move(part), square_around(circle), rest);
      for (const Wedge& wedge : near.wedges(circle.centre, circle.radius)) wedges.push_back(wedge);
    });
  }
  std::vector<PatchChart> charts;
  for (const FlatPart& part : parts) {
    if (part.empty()) continue;
    if (!part.straight()) {
      for (const Wedge& wedge : part.wedges(part.middle(), 0)) wedges.push_back(wedge);
      continue;
    }
    std::vector<Vec3> corners;
    for (const Vec2& corner : part.corners()) corners.push_back(flat.out(corner));
    add(corners, flat.normal, charts);
  }
  for (const Wedge& wedge : wedges) {
    PatchChart chart(Kind::wedge);
    chart.a_ = flat.out(wedge.apex), chart.b_ = flat.frame.u, chart.c_ = flat.frame.v, chart.normal_ = flat.normal;
    chart.wedge_ = wedge;
    charts.push_back(chart);
  }
  return charts;
}

// The ball is above the horizon of a point at the angle θ from the direction to its middle where D cos θ − R ≥ size, and
// below it where that is ≤ −size: the first bound divides the charts, the second ends them.
std::vector<PatchChart> PatchChart::of(const Sphere& sphere, const Vec3& towards, double size) {
  std::vector<PatchChart> charts;
  const Vec3 way = towards - sphere.centre;
  const double distance = way.norm();
  const Vec3 axis = distance > 0 ? Vec3(way / distance) : Vec3::UnitZ();
  const auto reach = [&](double height) { return std::acos(std::clamp(height / distance, -1.0, 1.0)); };
  const double whole = distance > size ? reach(sphere.radius + size) : 0;
  const double none = distance > size ? reach(sphere.radius - size) : kPi;
  const TangentFrame frame = tangent_frame(axis);
  for (const auto& [from, to] : {std::pair(0.0, whole), std::pair(whole, none)}) {
    if (!(to > from)) continue;
    for (int k = 0; k < kQuarters; ++k) {
      PatchChart chart(Kind::sphere);
      chart.a_ = sphere.centre, chart.b_ = frame.u, chart.c_ = frame.v, chart.normal_ = axis;
      chart.radius_ = sphere.radius;
      chart.turn_ = k * kPi / 2, chart.turns_ = kPi / 2;
      chart.tilt_ = from, chart.tilts_ = to - from;
      charts.push_back(chart);
    }
  }
  return charts;
}

// As with a sphere: at the angle θ from the lateral direction to the ball its middle is D cos θ − R above the horizon.
std::vector<PatchChart> PatchChart::of(const Cylinder& cylinder, const Vec3& towards, double size) {
  std::vector<PatchChart> charts;
  const Vec3 axis = (cylinder.top - cylinder.base).normalized(), way = towards - cylinder.base;
  const TangentFrame frame = frame_towards(axis, way);
  const double distance = (way - way.dot(axis) * axis).norm();
  const auto reach = [&](double height) { return std::acos(std::clamp(height / distance, -1.0, 1.0)); };
  const double whole = distance > 0 ? reach(cylinder.radius + size) : 0;
  const double none = distance > 0 ? reach(cylinder.radius - size) : kPi;
  const auto add_wall = [&](double from, double to) {
    PatchChart chart(Kind::wall);
    chart.a_ = cylinder.base, chart.b_ = frame.u, chart.c_ = frame.v, chart.d_ = cylinder.top - cylinder.base;
    chart.radius_ = cylinder.radius;
    chart.turn_ = from, chart.turns_ = to - from;
    charts.push_back(chart);
  };
  for (const auto& [from, to] : {std::pair(0.0, whole), std::pair(whole, none)}) {
    const int parts = to - from > kPi / 2 ? 2 : 1;
    for (int k = 0; k < parts && to > from; ++k) {
      const double begin = from + k * (to - from) / parts, end = from + (k + 1) * (to - from) / parts;
      add_wall(begin, end), add_wall(-end, -begin);
    }
  }
  return charts;
}

std::vector<PatchChart> PatchChart::covering(const CurvedPatch& patch, const Vec3& towards, double size,
                                             const PatchCuts& cuts) {
  if (const auto* sphere = std::get_if<Sphere>(&patch)) return of(*sphere, towards, size);
  if (const auto* cylinder = std::get_if<Cylinder>(&patch)) return of(*cylinder, towards, size);
  return of_flat(patch, cuts);
}

PatchSpot PatchChart::at(double s, double t) const {
  const double angle = turn_ + turns_ * t;
  switch (kind_) {
    case Kind::bilinear: {
      const Vec3 along = (1 - t) * (b_ - a_) + t * (c_ - d_), across = (1 - s) * (d_ - a_) + s * (c_ - b_);
      return {(1 - t) * ((1 - s) * a_ + s * b_) + t * ((1 - s) * d_ + s * c_), normal_,
              along.cross(across).dot(normal_)};
    }
    case Kind::fan: {
      const Vec3 far = (b_ - a_) + t * (c_ - b_);
      return {a_ + s * far, normal_, s * far.cross(c_ - b_).dot(normal_)};
    }
    case Kind::wedge: {
      const double at = wedge_.turn + wedge_.turns * t;
      const Vec2 way(std::cos(at), std::sin(at));
      const double from = wedge_.inner.along(way), width = wedge_.outer.along(way) - from, reach = from + s * width;
      return {a_ + reach * (way.x() * b_ + way.y() * c_), normal_, width * reach * wedge_.turns};
    }
    case Kind::sphere: {
      const double tilt = tilt_ + tilts_ * s, sine = std::sin(tilt);
      const Vec3 out = (std::cos(tilt) * normal_ + sine * (std::cos(angle) * b_ + std::sin(angle) * c_)).normalized();
      return {a_ + radius_ * out, out, radius_ * radius_ * sine * tilts_ * turns_};
    }
    default: {
      const Vec3 out = (std::cos(angle) * b_ + std::sin(angle) * c_).normalized();
      return {a_ + s * d_ + radius_ * out, out, radius_ * turns_ * d_.norm()};
    }
  }
}

std::optional<Plane> plane_of(const CurvedPatch& patch) {
  if (const auto* polygon = std::get_if<Polygon>(&patch)) return Plane{polygon->centroid(), polygon->normal()};
  if (const auto* disc = std::get_if<Disc>(&patch)) return Plane{disc->centre, disc->normal};
  return std::nullopt;
}

void add_footprint(const CurvedPatch& patch, const CurvedBlocker& blocker, std::vector<Footprint>& footprints) {
  const auto plane = plane_of(patch);
  if (!plane) return;
  const Vec3 point = plane->point, normal = plane->normal;
  const double size = ball_around(patch).size;
  const auto stands = [&](const Vec3& on) {
    return std::abs((on - point).dot(normal)) <= kStanding * (size + (on - point).norm() + point.cwiseAbs().maxCoeff());
  };
  if (const auto* cylinder = std::get_if<Cylinder>(&blocker)) {
    const Vec3 axis = cylinder->top - cylinder->base;
    if (axis.cross(normal).norm() > kStanding * axis.norm()) return;
    for (const Vec3& end : {cylinder->base, cylinder->top}) {
      if (stands(end)) footprints.push_back({{}, end, cylinder->radius});
    }
  } else if (const auto* solid = std::get_if<Blocker>(&blocker); solid != nullptr && solid->is_solid()) {
    for (const Blocker::Face& face : solid->faces()) {
      if (!(face.normal.dot(normal) < 0) || !std::all_of(face.corners.begin(), face.corners.end(),
                                                         [&](std::size_t k) { return stands(solid->points()[k]); })) {
        continue;
      }
      Footprint footprint;  // seen from the patch's front its corners run the other way
      for (auto corner = face.corners.rbegin(); corner != face.corners.rend(); ++corner) {
        footprint.loop.push_back(solid->points()[*corner]);
      }
      footprints.push_back(std::move(footprint));
    }
  }
}

PatchCuts cuts_of(const CurvedPatch& patch, const CurvedPatch& to, std::span<const CurvedBlocker* const> blockers) {
  PatchCuts cuts;
  const auto plane = plane_of(patch);
  for (const CurvedBlocker* blocker : blockers) {
    add_footprint(patch, *blocker, cuts.footprints);
    const auto* plate = std::get_if<Blocker>(blocker);
    if (!plane || plate == nullptr || plate->is_solid()) continue;
    const Vec3& corner = plate->points()[plate->faces().front().corners.front()];
    const double slack = kStanding * (ball_around(patch).size + corner.norm() + plane->point.norm());
    int on = 0;
    for (const Vec3& point : plate->points()) on += std::abs((point - plane->point).dot(plane->normal)) <= slack;
    if (on > 0) cuts.partings.push_back({corner, plate->faces().front().normal});
  }
  if (const auto* standing = std::get_if<Cylinder>(&to)) {
    add_footprint(patch, CurvedBlocker(*standing), cuts.footprints);
  } else if (const auto front = plane_of(to)) {
    cuts.fronts.push_back(*front);
  }
  return cuts;
}

PatchBall ball_around(const CurvedPatch& patch) {
  if (const auto* polygon = std::get_if<Polygon>(&patch)) {
    PatchBall ball{polygon->centroid(), 0};
    for (const Vec3& vertex : polygon->vertices()) ball.size = std::max(ball.size, (vertex - ball.middle).norm());
    return ball;
  }
  if (const auto* disc = std::get_if<Disc>(&patch)) return {disc->centre, disc->radius};
  if (const auto* sphere = std::get_if<Sphere>(&patch)) return {sphere->centre, sphere->radius};
  const auto& cylinder = std::get<Cylinder>(patch);
  const Vec3 half = 0.5 * (cylinder.top - cylinder.base);
  return {cylinder.base + half, std::hypot(half.norm(), cylinder.radius)};
}

double area_of(const CurvedPatch& patch) {
  if (const auto* polygon = std::get_if<Polygon>(&patch)) return polygon->area();
  if (const auto* disc = std::get_if<Disc>(&patch)) return kPi * disc->radius * disc->radius;
  if (const auto* sphere = std::get_if<Sphere>(&patch)) return 4 * kPi * sphere->radius * sphere->radius;
  const auto& cylinder = std::get<Cylinder>(patch);
  return 2 * kPi * cylinder.radius * (cylinder.top - cylinder.base).norm();
}

}  // namespace etendue
