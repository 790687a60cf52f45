// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/round_checks.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/form_factor/patch_chart.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

/// The point of a convex body that lies farthest in a direction; cylinders are filled.
Vec3 support(const CurvedPatch& shape, const Vec3& direction) {
  if (const auto* polygon = std::get_if<Polygon>(&shape)) {
    const auto& v = polygon->vertices();
    return *std::max_element(v.begin(), v.end(),
                             [&](const Vec3& a, const Vec3& b) { return a.dot(direction) < b.dot(direction); });
  }
  const auto on_rim = [&](const Vec3& centre, const Vec3& axis, double radius) -> Vec3 {
    const Vec3 across = direction - direction.dot(axis) * axis;
    return across.norm() > 0 ? Vec3(centre + radius * across.normalized()) : centre;
  };
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return sphere->centre + sphere->radius * direction.normalized();
  }
  if (const auto* disc = std::get_if<Disc>(&shape)) return on_rim(disc->centre, disc->normal, disc->radius);
  const auto& cylinder = std::get<Cylinder>(shape);
  const Vec3 axis = (cylinder.top - cylinder.base).normalized();
  return on_rim(axis.dot(direction) > 0 ? cylinder.top : cylinder.base, axis, cylinder.radius);
}

/// Do two convex bodies still meet when both are made smaller by kSunkShare? Gilbert's iteration walks to the point
/// of their difference that is nearest to the origin; a plane that separates them ends it.
bool pierces(const CurvedPatch& body, const CurvedPatch& other) {
  const PatchBall ball = ball_around(body), other_ball = ball_around(other);
  const auto shrunk = [](const CurvedPatch& shape, const PatchBall& around, const Vec3& direction) -> Vec3 {
    return around.middle + (1 - kSunkShare) * (support(shape, direction) - around.middle);
  };
  const auto difference = [&](const Vec3& direction) -> Vec3 {
    return shrunk(body, ball, direction) - shrunk(other, other_ball, -direction);
  };
  constexpr int kMostSteps = 3000;
  Vec3 nearest = difference(Vec3(1, 0.7, 0.4));
  for (int step = 0; step < kMostSteps; ++step) {
    if (nearest.norm() <= 0.1 * kSunkShare * ball.size) return true;
    const Vec3 corner = difference(-nearest);
    if (corner.dot(nearest) > 0) return false;
    const Vec3 way = corner - nearest;
    const double length = way.squaredNorm();
    if (!(length > 0)) return true;
    nearest += std::clamp(-nearest.dot(way) / length, 0.0, 1.0) * way;
  }
  return false;  // so slowly that they touch at most
}

/// Two sides of one plate, or of two that lie on one another.
bool back_to_back(const CurvedPatch& first, const CurvedPatch& second) {
  const auto a = plane_of(first), b = plane_of(second);
  if (!a || !b || a->normal.dot(b->normal) > 0) return false;
  const double size = ball_around(first).size + ball_around(second).size;
  return a->normal.cross(b->normal).norm() <= kTouching &&
         std::abs(a->normal.dot(a->point - b->point)) <= kTouching * (size + a->point.norm());
}

bool balls_apart(const PatchBall& a, const PatchBall& b) {
  return (a.middle - b.middle).norm() > a.size + b.size;
}

/// Does the polygon close this end of the cylinder?
bool closes(const Polygon& polygon, const Cylinder& cylinder, const Vec3& end) {
  std::vector<Footprint> footprints;
  add_footprint(CurvedPatch(polygon), CurvedBlocker(cylinder), footprints);
  for (const Footprint& footprint : footprints) {
    if (footprint.centre != end) continue;
    const auto& v = polygon.vertices();
    bool within = true;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vec3 inward = polygon.normal().cross(v[(k + 1) % v.size()] - v[k]).normalized();
      within = within && inward.dot(end - v[k]) >= cylinder.radius * (1 - kSunkShare);
    }
    if (within) return true;
  }
  return false;
}

}  // namespace

bool caps(const Disc& disc, const Cylinder& cylinder) {
  const Vec3 axis = cylinder.top - cylinder.base;
  const double slack = kTouching * (axis.norm() + cylinder.radius + cylinder.base.norm());
  return std::abs(disc.radius - cylinder.radius) <= slack &&
         disc.normal.cross(axis).norm() <= kTouching * axis.norm() &&
         std::min((disc.centre - cylinder.base).norm(), (disc.centre - cylinder.top).norm()) <= slack;
}

Result<Done> check_rounds(const Scene& scene, const SurfaceModel& model) {
  std::string lines;
  std::size_t count = 0;
  const auto complain = [&](std::size_t object, const std::string& what) {
    const std::string& place = scene.objects[object].place;
    lines +=
        (place.empty() ? "" : place + ": ") + "object '" + printable(scene.objects[object].name) + "' " + what + "\n";
    ++count;
  };
  for (std::size_t k = 0; k < model.rounds.size(); ++k) {
    const RoundSurface& round = model.rounds[k];
    const PatchBall ball = ball_around(round.shape);
    std::size_t reported = scene.objects.size();  // an object's faces are told of once
    const auto check = [&](const CurvedPatch& other, std::size_t object) {
      if (object == reported || balls_apart(ball, ball_around(other)) || back_to_back(round.shape, other) ||
          !pierces(round.shape, other))
        return;
      reported = object;
      complain(round.object, "pierces or lies in object '" + printable(scene.objects[object].name) +
                                 "': a round surface may touch others only");
    };
    for (const Face& face : model.mesh.faces) check(CurvedPatch(face.polygon), face.object);
    for (std::size_t m = 0; m < k; ++m) check(model.rounds[m].shape, model.rounds[m].object);
  }
  if (count == 0) return Done{};
  return Error{ErrorCode::invalid_input, lines + counted_errors(count)};
}

void note_open_cylinders(SurfaceModel& model) {
  for (const RoundSurface& round : model.rounds) {
    const auto* cylinder = std::get_if<Cylinder>(&round.shape);
    if (cylinder == nullptr) continue;
    int open = 0;
    for (const Vec3& end : {cylinder->base, cylinder->top}) {
      bool closed = false;
      for (const RoundSurface& other : model.rounds) {
        const auto* disc = std::get_if<Disc>(&other.shape);
        const double slack = kTouching * (cylinder->radius + end.norm());
        closed = closed || (disc != nullptr && caps(*disc, *cylinder) && (disc->centre - end).norm() <= slack);
      }
      for (const Face& face : model.mesh.faces) closed = closed || closes(face.polygon, *cylinder, end);
      open += closed ? 0 : 1;
    }
    if (open == 0) continue;
    model.notes.push_back("cylinder '" + printable(round.name) + "' has " + (open == 1 ? "an open end" : "open ends") +
                          ": its inside takes no part, and what enters there is lost; close it with discs");
  }
}

}  // namespace etendue
