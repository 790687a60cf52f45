// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/curved_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/assembly/round_checks.hpp"
#include "etendue/form_factor/curved_factor.hpp"
#include "etendue/form_factor/patch_chart.hpp"

namespace etendue {

namespace {

/// Objects of more faces are not tried as solids, as in SightMap.
constexpr std::size_t kMostFaces = 32;

struct Range {
  double low, high;
};

Range range_of(std::span<const Vec3> points, const Vec3& direction) {
  Range range{points.front().dot(direction), points.front().dot(direction)};
  for (const Vec3& point : points) {
    range = {std::min(range.low, point.dot(direction)), std::max(range.high, point.dot(direction))};
  }
  return range;
}

/// Least and greatest height along a unit vector.
template <class Shape>
Range round_range(const Shape& shape, const Vec3& direction) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    const double middle = sphere->centre.dot(direction);
    return {middle - sphere->radius, middle + sphere->radius};
  }
  const auto rim = [&](const Vec3& axis, double radius) { return radius * direction.cross(axis).norm(); };
  if (const auto* disc = std::get_if<Disc>(&shape)) {
    const double middle = disc->centre.dot(direction), width = rim(disc->normal, disc->radius);
    return {middle - width, middle + width};
  }
  const auto& cylinder = std::get<Cylinder>(shape);
  const double a = cylinder.base.dot(direction), b = cylinder.top.dot(direction);
  const double width = rim((cylinder.top - cylinder.base).normalized(), cylinder.radius);
  return {std::min(a, b) - width, std::max(a, b) + width};
}

Range range_of(const CurvedPatch& shape, const Vec3& direction) {
  if (const auto* polygon = std::get_if<Polygon>(&shape)) return range_of(polygon->vertices(), direction);
  return round_range(shape, direction);
}

CurvedBlocker as_blocker(const CurvedPatch& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return *sphere;
  if (const auto* disc = std::get_if<Disc>(&shape)) return *disc;
  return std::get<Cylinder>(shape);
}

/// From which of two the other is looked at: from the wall of a cylinder that stands on the other, since there the
/// horizon cuts smoothly what the other way is a singular contact; else from what is flat.
bool source_first(const CurvedPatch& first, const CurvedPatch& second) {
  const auto stands = [](const CurvedPatch& wall, const CurvedPatch& floor) {
    std::vector<Footprint> footprints;
    if (const auto* cylinder = std::get_if<Cylinder>(&wall)) add_footprint(floor, CurvedBlocker(*cylinder), footprints);
    return !footprints.empty();
  };
  if (stands(first, second)) return true;
  if (stands(second, first)) return false;
  const auto rank = [](const CurvedPatch& shape) {
    return std::holds_alternative<Polygon>(shape)    ? 0
           : std::holds_alternative<Disc>(shape)     ? 1
           : std::holds_alternative<Cylinder>(shape) ? 2
                                                     : 3;
  };
  return rank(first) <= rank(second);
}

}  // namespace

CurvedExchange::CurvedExchange(const SurfaceModel& model, const AssemblyTolerance& tolerance)
    : model_(model), tolerance_(tolerance), capped_by_(model.rounds.size()) {
  const std::vector<Face>& faces = model.mesh.faces;
  if (!faces.empty()) flat_.emplace(model.mesh, tolerance);
  double largest = 0;
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t last = first;
    std::vector<Polygon> polygons;
    for (; last < faces.size() && faces[last].object == faces[first].object; ++last)
      polygons.push_back(faces[last].polygon);
    auto solid = polygons.size() <= kMostFaces ? Blocker::solid(polygons) : std::nullopt;
    if (solid) bodies_.push_back({*solid, solid->points(), first, last, std::nullopt, std::nullopt});
    for (std::size_t f = first; f < last; ++f) {
      const Polygon& face = faces[f].polygon;
      for (const Vec3& vertex : face.vertices()) largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
      if (!solid) bodies_.push_back({Blocker::plate(face), face.vertices(), f, f + 1, std::nullopt, face.normal()});
    }
    first = last;
  }
  for (std::size_t k = 0; k < model.rounds.size(); ++k) {
    const CurvedPatch& shape = model.rounds[k].shape;
    const PatchBall ball = ball_around(shape);
    largest = std::max(largest, ball.middle.cwiseAbs().maxCoeff() + ball.size);
    bool cap = false;
    if (const auto* disc = std::get_if<Disc>(&shape)) {
      for (std::size_t m = 0; m < model.rounds.size(); ++m) {
        const auto* cylinder = std::get_if<Cylinder>(&model.rounds[m].shape);
        if (cylinder == nullptr || !caps(*disc, *cylinder)) continue;
        cap = true;  // the filled cylinder hides what it hides
        capped_by_[k].push_back(m);
        capped_by_[m].push_back(k);
      }
    }
    const auto* disc = std::get_if<Disc>(&shape);
    if (!cap) bodies_.push_back({as_blocker(shape), {}, 0, 0, k, disc ? std::optional(disc->normal) : std::nullopt});
  }
  slack_ = kTouching * largest;
}

CurvedExchange::Patch CurvedExchange::patch(std::size_t element) const {
  const std::size_t flat = model_.mesh.elements.size();
  const double area = model_.element_area(element);
  if (element < flat) {
    const Element& piece = model_.mesh.elements[element];
    return {piece.polygon, piece.face, std::nullopt, piece.polygon.normal(), area};
  }
  const CurvedPatch& shape = model_.rounds[element - flat].shape;
  const auto* disc = std::get_if<Disc>(&shape);
  return {shape, 0, element - flat, disc ? std::optional(disc->normal) : std::nullopt, area};
}

bool CurvedExchange::own(const Body& body, const Patch& patch) const {
  if (body.round.has_value() != patch.round.has_value()) return false;
  if (!body.round) return patch.face >= body.first_face && patch.face < body.last_face;
  const auto& caps = capped_by_[*patch.round];
  return *body.round == *patch.round || std::find(caps.begin(), caps.end(), *body.round) != caps.end();
}

// Conservative: a body is left out only where a plane or the boxes show that it does not reach between the two.
bool CurvedExchange::may_block(const Body& body, const Patch& first, const Patch& second) const {
  if (own(body, first) || own(body, second)) return false;
  const auto reach = [&](const Vec3& direction) {
    return body.round ? round_range(body.shape, direction) : range_of(body.points, direction);
  };
  for (const Patch* patch : {&first, &second}) {
    if (patch->normal && reach(*patch->normal).high <= range_of(patch->shape, *patch->normal).high + slack_)
      return false;
  }
  std::vector<Vec3> directions{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  if (body.plane_normal) directions.push_back(*body.plane_normal);
  const Vec3 way = ball_around(second.shape).middle - ball_around(first.shape).middle;
  if (way.norm() > 0) directions.push_back(way.normalized());
  for (const Vec3& direction : directions) {
    const Range a = range_of(first.shape, direction), b = range_of(second.shape, direction), c = reach(direction);
    if (c.low >= std::max(a.high, b.high) - slack_ || c.high <= std::min(a.low, b.low) + slack_) return false;
  }
  return true;
}

std::vector<const CurvedBlocker*> CurvedExchange::between(const Patch& first, const Patch& second, bool* round) const {
  std::vector<const CurvedBlocker*> found;
  *round = first.round.has_value() || second.round.has_value();
  for (const Body& body : bodies_) {
    if (!may_block(body, first, second)) continue;
    found.push_back(&body.shape);
    *round = *round || body.round.has_value();
  }
  return found;
}

Bounded CurvedExchange::find(const Patch& first, const Patch& second, TileReport& report) const {
  for (const auto& [front, other] : {std::pair(&first, &second), std::pair(&second, &first)}) {
    if (!front->normal) continue;
    if (range_of(other->shape, *front->normal).high <= range_of(front->shape, *front->normal).high + slack_) {
      ++report.averted;
      return {0, 0};
    }
  }
  bool round = false;
  const auto blockers = between(first, second, &round);
  ++(blockers.empty() ? report.clear : report.obstructed);
  // The absolute error is larger as seen from the smaller surface.
  CurvedGoal goal;
  const Tolerance asked = with_room(blockers.empty() ? tolerance_.free : tolerance_.obstructed);
  goal.relative = asked.relative;
  goal.absolute = asked.absolute * std::min(first.area, second.area);
  const bool in_order = source_first(first.shape, second.shape);
  return curved_exchange(in_order ? first.shape : second.shape, in_order ? second.shape : first.shape, blockers, goal);
}

void CurvedExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const {
  const std::size_t flat = model_.mesh.elements.size();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Patch first = patch(pairs[k].i), second = patch(pairs[k].j);
    bool round = true;
    if (pairs[k].j < flat) between(first, second, &round);
    if (round) {
      exchanges[k] = find(first, second, report);
    } else {
      flat_->find(pairs.subspan(k, 1), exchanges.subspan(k, 1), report);
    }
  }
}

std::vector<std::size_t> CurvedExchange::blockers(const SurfacePair& pair) const {
  std::vector<std::size_t> found;
  const Patch first = patch(pair.i), second = patch(pair.j);
  for (const Body& body : bodies_) {
    if (!may_block(body, first, second)) continue;
    found.push_back(body.round ? model_.mesh.faces.size() + *body.round : body.first_face);
  }
  return found;
}

}  // namespace etendue
