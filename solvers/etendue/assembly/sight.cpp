// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "etendue/assembly/shells.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A corner is off by up to 4u of its coordinates after a transform and a subdivision, a centroid and a unit normal by as
/// much; a height takes two corners, the normal times their distance, and a dot product: 24u. More than twice that.
constexpr double kHeightRoundings = 64;

/// More normals are not tried, which grow as the cube of the corners: what might be separated then counts as obstructed,
/// which costs time, not truth. A pair of hexagons and a box need 36 · (3 + 12).
constexpr std::size_t kMostNormals = 10'000;

/// Objects of more faces are not tried as solids: that compares every face with every corner.
constexpr std::size_t kMostFaces = 32;

double height(const Polygon& plane, const Vec3& point) {
  return plane.normal().dot(point - plane.centroid());
}

double greatest_height(const Polygon& plane, std::span<const Vec3> points) {
  double greatest = -kInfinity;
  for (const Vec3& point : points) greatest = std::max(greatest, height(plane, point));
  return greatest;
}

struct Range {
  double low = kInfinity;
  double high = -kInfinity;
};

Range heights(const Polygon& plane, const Polygon& polygon) {
  Range range;
  for (const Vec3& vertex : polygon.vertices()) {
    const double value = height(plane, vertex);
    range = {std::min(range.low, value), std::max(range.high, value)};
  }
  return range;
}

/// The point of a set that is farthest along an axis.
struct Farthest {
  double value = -kInfinity;
  const Vec3* point = nullptr;
  void add(std::span<const Vec3> points, const Vec3& axis) {
    for (const Vec3& p : points) {
      const double along = axis.dot(p);
      if (along > value) {
        value = along;
        point = &p;
      }
    }
  }
};

/// Whether the line from a to b passes through the convex set behind all planes, deeper than `skin`.
bool pierced(const ElementMesh& mesh, std::span<const std::size_t> planes, const Vec3& a, const Vec3& b, double skin) {
  double enters = 0, leaves = 1;
  for (const std::size_t f : planes) {
    const double from = height(mesh.faces[f].polygon, a) + skin, to = height(mesh.faces[f].polygon, b) + skin;
    if (from >= 0 && to >= 0) return false;
    if (from > 0) enters = std::max(enters, from / (from - to));
    if (to > 0) leaves = std::min(leaves, from / (from - to));
  }
  return enters < leaves;
}

}  // namespace

struct SightMap::Pair {
  const Polygon &from, &to;
  const Ball &near, &far;
  Bounds bounds;
  Pair(const Polygon& first, const Hull& first_hull, const Polygon& second, const Hull& second_hull)
      : from(first),
        to(second),
        near(first_hull.ball),
        far(second_hull.ball),
        bounds{first_hull.bounds.low.cwiseMin(second_hull.bounds.low),
               first_hull.bounds.high.cwiseMax(second_hull.bounds.high)} {}
};

SightMap::Hull SightMap::hull_of(const Polygon& polygon) {
  Hull hull{{polygon.centroid(), 0}, {polygon.vertices().front(), polygon.vertices().front()}};
  for (const Vec3& vertex : polygon.vertices()) {
    hull.bounds.low = hull.bounds.low.cwiseMin(vertex);
    hull.bounds.high = hull.bounds.high.cwiseMax(vertex);
    hull.ball.radius = std::max(hull.ball.radius, (vertex - hull.ball.centre).norm());
  }
  return hull;
}

SightMap::SightMap(const ElementMesh& mesh) : mesh_(mesh), counts_(mesh.faces.size()) {
  for (const Face& face : mesh.faces) faces_.push_back(hull_of(face.polygon));
  for (const Element& element : mesh.elements) {
    elements_.push_back(hull_of(element.polygon));
    ++counts_[element.face];
  }
  double largest = 0;
  for (const Face& face : mesh.faces) {
    const std::vector<Vec3>& v = face.polygon.vertices();
    inward_.emplace_back();
    for (std::size_t k = 0; k < v.size(); ++k) {
      largest = std::max(largest, v[k].cwiseAbs().maxCoeff());
      inward_.back().push_back(face.polygon.normal().cross(v[(k + 1) % v.size()] - v[k]).normalized());
    }
  }
  slack_ = kHeightRoundings * kUnitRoundoff * largest;
  gather_bodies();
  for (std::size_t b = 0; b < bodies_.size(); ++b) all_bodies_.push_back(b);
}

// Solids first by objects, then by what closes one together; what is left blocks face by face.
void SightMap::gather_bodies() {
  const std::size_t count = mesh_.faces.size();
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    groups.emplace_back();
    while (last < count && mesh_.faces[last].object == mesh_.faces[first].object) groups.back().push_back(last++);
  }
  const std::vector<Polygon> polygons = welded(mesh_.faces, slack_);
  for (std::vector<std::size_t>& shell : closed_shells(polygons)) groups.push_back(std::move(shell));
  std::vector<char> taken(count, 0);
  for (const std::vector<std::size_t>& group : groups) {
    const auto is_taken = [&](std::size_t f) { return taken[f] != 0; };
    if (std::any_of(group.begin(), group.end(), is_taken)) continue;
    if (!add_solid(group, polygons)) continue;
    for (const std::size_t f : group) taken[f] = 1;
  }
  for (std::size_t f = 0; f < count; ++f) {
    if (taken[f] == 0) add_body(std::span(&f, 1), Blocker::plate(mesh_.faces[f].polygon));
  }
}

// Inside a solid there is no light; several objects that close a room of their own are no solid.
bool SightMap::add_solid(std::span<const std::size_t> faces, const std::vector<Polygon>& welded_faces) {
  if (faces.size() > kMostFaces) return false;
  std::vector<Polygon> polygons;
  for (const std::size_t f : faces) polygons.push_back(welded_faces[f]);
  std::optional<Blocker> solid = Blocker::solid(polygons);
  if (!solid) return false;
  const std::size_t before = bodies_.size();
  add_body(faces, *std::move(solid));
  const bool one_object = mesh_.faces[faces.front()].object == mesh_.faces[faces.back()].object;
  if (one_object || bodies_.size() == before || !reached_into(bodies_.back())) return true;
  bodies_.pop_back();
  blockers_.pop_back();
  return false;
}

/// Whether an element may reach into a solid.
bool SightMap::reached_into(const Body& body) const {
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    const Polygon& polygon = mesh_.elements[e].polygon;
    const auto beyond = [&](std::size_t face) { return heights(mesh_.faces[face].polygon, polygon).low >= -slack_; };
    if (std::any_of(body.planes.begin(), body.planes.end(), beyond)) continue;
    const Pair pair(polygon, elements_[e], polygon, elements_[e]);
    if (!reflected_apart(body, pair) && !separated(body, pair)) return true;
  }
  return false;
}

// A face with all elements on one side of its plane blocks nothing: the walls of a convex room cost nothing from here on.
void SightMap::add_body(std::span<const std::size_t> faces, Blocker blocker) {
  constexpr double kParallel = 0x1p-20;  // saves axes that say the same; which ones are tried proves nothing
  Body body;
  for (const std::size_t f : faces) {
    Range range;
    for (const Element& element : mesh_.elements) {
      const Range one = heights(mesh_.faces[f].polygon, element.polygon);
      range = {std::min(range.low, one.low), std::max(range.high, one.high)};
    }
    if (blocker.is_solid() && range.low >= -slack_) return;  // all elements beyond one face of it
    body.planes.push_back(f);
    if (range.low < -slack_ && range.high > slack_) body.faces.push_back(f);
    const auto& v = mesh_.faces[f].polygon.vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vec3 edge = (v[(k + 1) % v.size()] - v[k]).normalized();
      const auto same = [&](const Vec3& other) { return other.cross(edge).squaredNorm() < kParallel * kParallel; };
      if (std::none_of(body.directions.begin(), body.directions.end(), same)) body.directions.push_back(edge);
    }
  }
  if (body.faces.empty()) return;
  const std::vector<Vec3>& points = blocker.points();
  body.bounds = {points.front(), points.front()};
  for (const Vec3& p : points) body.bounds = {body.bounds.low.cwiseMin(p), body.bounds.high.cwiseMax(p)};
  body.ball = {0.5 * (body.bounds.low + body.bounds.high), 0};
  for (const Vec3& p : points) body.ball.radius = std::max(body.ball.radius, (p - body.ball.centre).norm());
  body.blocker = blockers_.size();
  blockers_.push_back(std::move(blocker));
  bodies_.push_back(std::move(body));
}

SightLine SightMap::between(std::size_t first, std::size_t second) const {
  return look(first, second, all_bodies_);
}

// What does not come between an element and a whole face does not come between it and a part.
SightLine SightMap::between(std::size_t first, std::size_t second, Approach& approach) const {
  constexpr std::size_t kFew = 4;  // elements of a face for which a look at all of it does not pay
  const std::size_t face = mesh_.elements[second].face;
  if (counts_[face] <= kFew) return look(first, second, all_bodies_);
  if (approach.first_ != first || approach.face_ != face) {
    approach.first_ = first;
    approach.face_ = face;
    approach.bodies_.clear();
    const Pair pair(mesh_.elements[first].polygon, elements_[first], mesh_.faces[face].polygon, faces_[face]);
    for (const std::size_t body : all_bodies_) {
      const Body& one = bodies_[body];
      if (!set_aside(one, pair) && !beyond_face(one, pair) && !reflected_apart(one, pair))
        approach.bodies_.push_back(body);
    }
  }
  return look(first, second, approach.bodies_);
}

SightLine SightMap::look(std::size_t first, std::size_t second, std::span<const std::size_t> bodies) const {
  const Polygon &from = mesh_.elements[first].polygon, &to = mesh_.elements[second].polygon;
  if (greatest_height(from, to.vertices()) <= slack_ || greatest_height(to, from.vertices()) <= slack_) {
    return {PairSight::averted, {}, {}};
  }
  const Pair pair(from, elements_[first], to, elements_[second]);
  SightLine line{PairSight::clear, {}, {}};
  for (const std::size_t index : bodies) {
    const Body& body = bodies_[index];
    if (!stands_between(body, pair)) continue;
    if (hides_all(body, pair)) return {PairSight::blocked, {}, {}};
    bool any = false;
    for (const std::size_t face : body.faces) {
      if (face == mesh_.elements[first].face || face == mesh_.elements[second].face || !splits(face, pair)) continue;
      if (hides_all(face, pair)) return {PairSight::blocked, {}, {}};
      any = true;
      line.blockers.push_back(face);
    }
    if (!any) {
      // Lines that pass through it do not enter it: both lie inside, as those of floor and ceiling do under a pillar.
      if (pierces(body, pair)) return {PairSight::blocked, {}, {}};
      continue;
    }
    line.sight = PairSight::undecided;
    line.bodies.push_back(&blockers_[body.blocker]);
  }
  return line;
}

// By what costs little: most of what does not stand between two elements is found here.
bool SightMap::set_aside(const Body& body, const Pair& pair) const {
  // The space between is inside the ball that moves from the one element to the other with the larger of their radii.
  const Vec3 across = pair.far.centre - pair.near.centre, away = body.ball.centre - pair.near.centre;
  const double share = std::clamp(across.dot(away) / across.squaredNorm(), 0.0, 1.0);
  const double reach = body.ball.radius + std::max(pair.near.radius, pair.far.radius);
  if ((away - share * across).squaredNorm() >= reach * reach) return true;
  for (int axis = 0; axis < 3; ++axis) {
    if (body.bounds.low(axis) >= pair.bounds.high(axis) - slack_) return true;
    if (body.bounds.high(axis) <= pair.bounds.low(axis) + slack_) return true;
  }
  const std::vector<Vec3>& points = blockers_[body.blocker].points();
  return greatest_height(pair.from, points) <= slack_ || greatest_height(pair.to, points) <= slack_;
}

bool SightMap::stands_between(const Body& body, const Pair& pair) const {
  if (set_aside(body, pair)) return false;
  if (pierces(body, pair)) return true;
  return !beyond_face(body, pair) && !reflected_apart(body, pair) && !separated(body, pair);
}

/// Whether the pair lies beyond one face of the body.
bool SightMap::beyond_face(const Body& body, const Pair& pair) const {
  const bool solid = blockers_[body.blocker].is_solid();
  for (const std::size_t f : body.planes) {
    const Range a = heights(mesh_.faces[f].polygon, pair.from), b = heights(mesh_.faces[f].polygon, pair.to);
    if (std::min(a.low, b.low) >= -slack_) return true;
    if (!solid && std::max(a.high, b.high) <= slack_) return true;
  }
  return false;
}

// A plane between the elements and the body: an axis is reflected at the two points that contradict it most (Chung and Wang).
bool SightMap::reflected_apart(const Body& body, const Pair& pair) const {
  constexpr int kReflections = 6;
  const std::vector<Vec3>& points = blockers_[body.blocker].points();
  Vec3 axis = body.ball.centre - 0.5 * (pair.near.centre + pair.far.centre);
  for (int k = 0; k < kReflections; ++k) {
    const double length = axis.norm();
    if (!(length > slack_)) break;
    axis /= length;
    Farthest between, back;
    between.add(pair.from.vertices(), axis);
    between.add(pair.to.vertices(), axis);
    back.add(points, -axis);
    if (-back.value >= between.value - slack_) return true;
    const Vec3 contradiction = *back.point - *between.point;
    const double square = contradiction.squaredNorm();
    if (!(square > 0)) break;
    axis -= 2 * (axis.dot(contradiction) / square) * contradiction;
  }
  return false;
}

// Among the normals that bound the difference of the two convex sets: see NOTES.md §1 (d).
bool SightMap::separated(const Body& body, const Pair& pair) const {
  const std::vector<Vec3>& points = blockers_[body.blocker].points();
  const std::size_t corners = pair.from.vertices().size() + pair.to.vertices().size();
  const std::size_t lines = pair.from.vertices().size() * pair.to.vertices().size();
  if (lines * (body.directions.size() + corners) > kMostNormals) return false;
  // What a line between two corners passes through is not separated by any plane.
  for (const Vec3& p : pair.from.vertices()) {
    for (const Vec3& q : pair.to.vertices()) {
      if (blockers_[body.blocker].is_solid() && pierced(mesh_, body.planes, p, q, 2 * slack_)) return false;
    }
  }
  const auto separates = [&](const Vec3& normal) {
    const double length = normal.norm();
    if (!(length > slack_ * slack_)) return false;  // the two directions are parallel, or one of them has no length
    Farthest ahead, behind, over, under;
    ahead.add(pair.from.vertices(), normal);
    ahead.add(pair.to.vertices(), normal);
    under.add(points, -normal);
    if (-under.value >= ahead.value - slack_ * length) return true;
    over.add(points, normal);
    behind.add(pair.from.vertices(), -normal);
    behind.add(pair.to.vertices(), -normal);
    return -behind.value >= over.value - slack_ * length;
  };
  for (const Vec3& p : pair.from.vertices()) {
    for (const Vec3& q : pair.to.vertices()) {
      const Vec3 joining = q - p;
      for (const Vec3& direction : body.directions) {
        if (separates(joining.cross(direction))) return true;
      }
      for (const Polygon* polygon : {&pair.from, &pair.to}) {
        const auto& v = polygon->vertices();
        for (std::size_t k = 0; k < v.size(); ++k) {
          if (separates(joining.cross(v[(k + 1) % v.size()] - v[k]))) return true;
        }
      }
    }
  }
  return false;
}

bool SightMap::splits(std::size_t face, const Pair& pair) const {
  const Polygon& plane = mesh_.faces[face].polygon;
  const Range a = heights(plane, pair.from), b = heights(plane, pair.to);
  if (std::min(a.low, b.low) >= -slack_ || std::max(a.high, b.high) <= slack_) return false;  // both on one side
  return greatest_height(pair.from, plane.vertices()) > slack_ && greatest_height(pair.to, plane.vertices()) > slack_;
}

/// Whether the line between the two middles passes through a solid, deeper than rounding.
bool SightMap::pierces(const Body& body, const Pair& pair) const {
  return blockers_[body.blocker].is_solid() &&
         pierced(mesh_, body.planes, pair.near.centre, pair.far.centre, 2 * slack_);
}

// The lines between corners pass through the solid, deeper than rounding: then so do all lines between the two (NOTES.md §1).
bool SightMap::hides_all(const Body& body, const Pair& pair) const {
  if (!pierces(body, pair)) return false;
  for (const Vec3& p : pair.from.vertices()) {
    for (const Vec3& q : pair.to.vertices()) {
      if (!pierced(mesh_, body.planes, p, q, 2 * slack_)) return false;
    }
  }
  return true;
}

// The lines between corners cross the face's plane inside the face: then so do all lines between the two (NOTES.md §1).
bool SightMap::hides_all(std::size_t face, const Pair& pair) const {
  const Polygon& blocker = mesh_.faces[face].polygon;
  const Range a = heights(blocker, pair.from), b = heights(blocker, pair.to);
  if (!(a.high < -slack_ && b.low > slack_) && !(a.low > slack_ && b.high < -slack_)) return false;
  const auto& v = blocker.vertices();
  for (const Vec3& p : pair.from.vertices()) {
    const double p_height = height(blocker, p);
    for (const Vec3& q : pair.to.vertices()) {
      const double q_height = height(blocker, q);
      const Vec3 crossing = (q_height * p - p_height * q) / (q_height - p_height);
      for (std::size_t k = 0; k < v.size(); ++k) {
        if (inward_[face][k].dot(crossing - v[k]) < slack_) return false;
      }
    }
  }
  return true;
}

}  // namespace etendue
