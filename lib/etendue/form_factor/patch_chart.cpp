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

using Loop3 = std::vector<Vec3>;

/// Nearer to a plane than this share of their distance from the origin, things stand on it.
constexpr double kStanding = 0x1p-40;

struct Parts {
  Loop3 outside, inside;
};
/// A convex loop, cut by the line through `point` across `outward`. What is nearer than rounding counts as on the line.
Parts split(const Loop3& loop, const Vec3& point, const Vec3& outward) {
  Parts parts;
  std::vector<double> heights;
  double extent = 0;
  for (const Vec3& v : loop) extent = std::max(extent, (v - point).norm());
  for (const Vec3& v : loop) {
    const double height = (v - point).dot(outward);
    heights.push_back(std::abs(height) <= kStanding * extent ? 0 : height);
  }
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::size_t next = (k + 1) % loop.size();
    if (heights[k] >= 0) parts.outside.push_back(loop[k]);
    if (heights[k] <= 0) parts.inside.push_back(loop[k]);
    if (heights[k] * heights[next] < 0) {
      const Vec3 crossing = (heights[next] * loop[k] - heights[k] * loop[next]) / (heights[next] - heights[k]);
      parts.outside.push_back(crossing);
      parts.inside.push_back(crossing);
    }
  }
  if (loop.empty()) return parts;
  // What only touches the line has no area.
  if (*std::max_element(heights.begin(), heights.end()) <= 0) parts.outside.clear();
  if (*std::min_element(heights.begin(), heights.end()) >= 0) parts.inside.clear();
  return parts;
}

Loop3 square_around(const Footprint& circle, const Vec3& normal) {
  constexpr double kWider = 1.25;  // so that the charts between circle and square keep a width
  const TangentFrame frame = tangent_frame(normal);
  const Vec3 u = kWider * circle.radius * frame.u, v = kWider * circle.radius * frame.v;
  return {circle.centre - u - v, circle.centre + u - v, circle.centre + u + v, circle.centre - u + v};
}

bool holds_circle(const Loop3& loop, const Vec3& normal, const Footprint& circle) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 inward = normal.cross(loop[(k + 1) % loop.size()] - loop[k]).normalized();
    if ((circle.centre - loop[k]).dot(inward) <= circle.radius) return false;
  }
  return true;
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

// From the circle to each edge, along the rays from its centre.
void PatchChart::add_around(std::span<const Vec3> v, const Vec3& normal, const Footprint& circle,
                            std::vector<PatchChart>& charts) {
  for (std::size_t k = 0; k < v.size(); ++k) {
    PatchChart chart(Kind::around);
    chart.a_ = circle.centre, chart.b_ = v[k] - circle.centre, chart.c_ = v[(k + 1) % v.size()] - v[k];
    chart.normal_ = normal;
    chart.inner_ = circle.radius;
    charts.push_back(chart);
  }
}

std::vector<PatchChart> PatchChart::of(const Polygon& polygon, const PatchCuts& cuts) {
  std::vector<PatchChart> charts;
  std::vector<Loop3> parts{polygon.vertices()};
  const Vec3& normal = polygon.normal();
  for (const Plane& front : cuts.fronts) parts.front() = split(parts.front(), front.point, front.normal).outside;
  for (const Plane& parting : cuts.partings) {
    std::vector<Loop3> halves;
    for (const Loop3& part : parts) {
      auto [outside, inside] = split(part, parting.point, parting.normal);
      if (outside.size() >= 3) halves.push_back(std::move(outside));
      if (inside.size() >= 3) halves.push_back(std::move(inside));
    }
    parts = std::move(halves);
  }
  for (const Footprint& footprint : cuts.footprints) {
    const Loop3 hole = footprint.loop.empty() ? square_around(footprint, normal) : footprint.loop;
    std::vector<Loop3> rest;
    for (Loop3& part : parts) {
      for (std::size_t k = 0; k < hole.size() && part.size() >= 3; ++k) {
        const Vec3 outward = (hole[(k + 1) % hole.size()] - hole[k]).cross(normal).normalized();
        auto [outside, inside] = split(part, hole[k], outward);
        if (outside.size() >= 3) rest.push_back(std::move(outside));
        part = std::move(inside);
      }
      // Of a circle's square only what is whole has the ring cut out; what is left of another is dark in part.
      if (part.size() < 3 || !footprint.loop.empty()) continue;
      if (holds_circle(part, normal, footprint)) {
        add_around(part, normal, footprint, charts);
      } else {
        rest.push_back(std::move(part));
      }
    }
    parts = std::move(rest);
  }
  for (const Loop3& part : parts) add(part, normal, charts);
  return charts;
}

std::vector<PatchChart> PatchChart::of(const Disc& disc, std::span<const Footprint> footprints) {
  std::vector<PatchChart> charts;
  const TangentFrame frame = tangent_frame(disc.normal);
  for (int k = 0; k < kQuarters; ++k) {
    PatchChart chart(Kind::disc);
    chart.a_ = disc.centre, chart.b_ = frame.u, chart.c_ = frame.v, chart.normal_ = disc.normal;
    chart.radius_ = disc.radius;
    chart.turn_ = k * kPi / 2, chart.turns_ = kPi / 2;
    for (const Footprint& circle : footprints) {
      if (!circle.loop.empty() || (circle.centre - disc.centre).norm() + circle.radius > disc.radius) continue;
      chart.kind_ = Kind::ring;
      chart.d_ = disc.centre - circle.centre;
      chart.a_ = circle.centre;
      chart.inner_ = circle.radius;
      break;
    }
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

std::vector<PatchChart> PatchChart::of(const Cylinder& cylinder, const Vec3& towards) {
  std::vector<PatchChart> charts;
  const Vec3 axis = (cylinder.top - cylinder.base).normalized();
  const TangentFrame frame = frame_towards(axis, towards - cylinder.base);
  for (int k = 0; k < kQuarters; ++k) {
    PatchChart chart(Kind::wall);
    chart.a_ = cylinder.base, chart.b_ = frame.u, chart.c_ = frame.v, chart.d_ = cylinder.top - cylinder.base;
    chart.radius_ = cylinder.radius;
    chart.turn_ = (k - 2) * kPi / 2, chart.turns_ = kPi / 2;
    charts.push_back(chart);
  }
  return charts;
}

std::vector<PatchChart> PatchChart::covering(const CurvedPatch& patch, const Vec3& towards, double size,
                                             const PatchCuts& cuts) {
  if (const auto* polygon = std::get_if<Polygon>(&patch)) return of(*polygon, cuts);
  if (const auto* disc = std::get_if<Disc>(&patch)) return of(*disc, cuts.footprints);
  if (const auto* sphere = std::get_if<Sphere>(&patch)) return of(*sphere, towards, size);
  return of(std::get<Cylinder>(patch), towards);
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
    case Kind::disc: {
      const Vec3 out = std::cos(angle) * b_ + std::sin(angle) * c_;
      return {a_ + s * radius_ * out, normal_, s * radius_ * radius_ * turns_};
    }
    case Kind::around: {
      const Vec3 out = b_ + t * c_;
      const double share = inner_ / out.norm(), reach = share + s * (1 - share);
      return {a_ + reach * out, normal_, (1 - share) * reach * out.cross(c_).dot(normal_)};
    }
    case Kind::ring: {
      const Vec3 rim = radius_ * (std::cos(angle) * b_ + std::sin(angle) * c_), out = d_ + rim;
      const Vec3 turning = radius_ * turns_ * (std::cos(angle) * c_ - std::sin(angle) * b_);
      const double share = inner_ / out.norm(), reach = share + s * (1 - share);
      return {a_ + reach * out, normal_, (1 - share) * reach * out.cross(turning).dot(normal_)};
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

void add_footprint(const CurvedPatch& patch, const CurvedBlocker& blocker, std::vector<Footprint>& footprints) {
  Vec3 point, normal;
  if (const auto* polygon = std::get_if<Polygon>(&patch)) {
    point = polygon->centroid(), normal = polygon->normal();
  } else if (const auto* disc = std::get_if<Disc>(&patch)) {
    point = disc->centre, normal = disc->normal;
  } else {
    return;
  }
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
  const auto* polygon = std::get_if<Polygon>(&patch);
  for (const CurvedBlocker* blocker : blockers) {
    add_footprint(patch, *blocker, cuts.footprints);
    const auto* plate = std::get_if<Blocker>(blocker);
    if (polygon == nullptr || plate == nullptr || plate->is_solid()) continue;
    const Vec3& corner = plate->points()[plate->faces().front().corners.front()];
    const double slack = kStanding * (ball_around(patch).size + corner.norm() + polygon->centroid().norm());
    int on = 0;
    for (const Vec3& point : plate->points())
      on += std::abs((point - polygon->centroid()).dot(polygon->normal())) <= slack;
    if (on > 0) cuts.partings.push_back({corner, plate->faces().front().normal});
  }
  if (const auto* standing = std::get_if<Cylinder>(&to)) {
    add_footprint(patch, CurvedBlocker(*standing), cuts.footprints);
  } else if (const auto* facing = std::get_if<Polygon>(&to)) {
    cuts.fronts.push_back({facing->centroid(), facing->normal()});
  } else if (const auto* disc = std::get_if<Disc>(&to)) {
    cuts.fronts.push_back({disc->centre, disc->normal});
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
