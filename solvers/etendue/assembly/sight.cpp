// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/sight.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A corner is off by up to 4u of its coordinates after a transform and a subdivision, a centroid and a unit normal by as
/// much; a height takes two corners, the normal times their distance, and a dot product: 24u. More than twice that.
constexpr double kHeightRoundings = 64;

/// Objects of more faces are not tried as solids: that compares every face with every corner.
constexpr std::size_t kMostFaces = 32;

double height(const Polygon& plane, const Vec3& point) {
  return plane.normal().dot(point - plane.centroid());
}

double greatest_height(const Polygon& plane, const Polygon& polygon) {
  double greatest = -kInfinity;
  for (const Vec3& vertex : polygon.vertices()) greatest = std::max(greatest, height(plane, vertex));
  return greatest;
}

struct Projection {
  double low = kInfinity;
  double high = -kInfinity;
  void add(const Polygon& polygon, const Vec3& axis) {
    for (const Vec3& vertex : polygon.vertices()) {
      const double value = axis.dot(vertex);
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
};

}  // namespace

SightMap::SightMap(const ElementMesh& mesh) : mesh_(mesh) {
  const auto bounds_of = [](const Polygon& polygon) {
    Bounds bounds{polygon.vertices().front(), polygon.vertices().front()};
    for (const Vec3& vertex : polygon.vertices()) {
      bounds.low = bounds.low.cwiseMin(vertex);
      bounds.high = bounds.high.cwiseMax(vertex);
    }
    return bounds;
  };
  for (const Face& face : mesh.faces) face_bounds_.push_back(bounds_of(face.polygon));
  for (const Element& element : mesh.elements) element_bounds_.push_back(bounds_of(element.polygon));
  double largest = 0;
  for (const Bounds& bounds : face_bounds_) {
    largest = std::max({largest, bounds.low.cwiseAbs().maxCoeff(), bounds.high.cwiseAbs().maxCoeff()});
  }
  slack_ = kHeightRoundings * kUnitRoundoff * largest;
  gather_bodies();
  heights_.reserve(mesh.faces.size() * mesh.elements.size());
  for (const Face& face : mesh.faces) {
    for (const Element& element : mesh.elements) {
      Range range{kInfinity, -kInfinity};
      for (const Vec3& vertex : element.polygon.vertices()) {
        const double value = height(face.polygon, vertex);
        range = {std::min(range.low, value), std::max(range.high, value)};
      }
      heights_.push_back(range);
    }
  }
}

void SightMap::gather_bodies() {
  for (std::size_t first = 0; first < mesh_.faces.size();) {
    std::size_t last = first;
    std::vector<Polygon> faces;
    while (last < mesh_.faces.size() && mesh_.faces[last].object == mesh_.faces[first].object) {
      faces.push_back(mesh_.faces[last++].polygon);
    }
    std::optional<Blocker> solid;
    if (faces.size() <= kMostFaces) solid = Blocker::solid(faces);
    for (std::size_t f = first; f < last; ++f) {
      if (!solid) bodies_.push_back(Blocker::plate(mesh_.faces[f].polygon));
      body_of_.push_back(solid ? bodies_.size() : bodies_.size() - 1);
    }
    if (solid) bodies_.push_back(*std::move(solid));
    first = last;
  }
}

SightLine SightMap::between(std::size_t first, std::size_t second) const {
  const Polygon& from = mesh_.elements[first].polygon;
  const Polygon& to = mesh_.elements[second].polygon;
  if (greatest_height(from, to) <= slack_ || greatest_height(to, from) <= slack_) return {Sight::averted, {}, {}};
  SightLine line{Sight::clear, {}, {}};
  for (std::size_t face = 0; face < mesh_.faces.size(); ++face) {
    if (!may_block(face, first, second)) continue;
    if (hides_all(face, first, second)) return {Sight::blocked, {}, {}};
    line.sight = Sight::undecided;
    line.blockers.push_back(face);
    const Blocker* body = &bodies_[body_of_[face]];
    // Faces of an object follow one another.
    if (line.bodies.empty() || line.bodies.back() != body) line.bodies.push_back(body);
  }
  return line;
}

bool SightMap::may_block(std::size_t face, std::size_t first, std::size_t second) const {
  if (face == mesh_.elements[first].face || face == mesh_.elements[second].face) return false;
  const Range& a = heights_[face * mesh_.elements.size() + first];
  const Range& b = heights_[face * mesh_.elements.size() + second];
  if (std::min(a.low, b.low) >= -slack_ || std::max(a.high, b.high) <= slack_) return false;  // both on one side
  const Vec3 low = element_bounds_[first].low.cwiseMin(element_bounds_[second].low);
  const Vec3 high = element_bounds_[first].high.cwiseMax(element_bounds_[second].high);
  for (int axis = 0; axis < 3; ++axis) {
    if (face_bounds_[face].low(axis) >= high(axis) - slack_) return false;
    if (face_bounds_[face].high(axis) <= low(axis) + slack_) return false;
  }
  const Polygon& blocker = mesh_.faces[face].polygon;
  if (greatest_height(mesh_.elements[first].polygon, blocker) <= slack_) return false;  // behind one of the two
  if (greatest_height(mesh_.elements[second].polygon, blocker) <= slack_) return false;
  return !separated(face, first, second);
}

// Looks for a plane with both elements on one side and the face on the other. Its normals are taken from those that
// bound the difference of the two convex sets: an edge of one element with a corner of the other, an edge of the face
// with a line that joins the elements.
bool SightMap::separated(std::size_t face, std::size_t first, std::size_t second) const {
  const Polygon& from = mesh_.elements[first].polygon;
  const Polygon& to = mesh_.elements[second].polygon;
  const Polygon& blocker = mesh_.faces[face].polygon;
  const auto separates = [&](const Vec3& axis) {
    const double length = axis.norm();
    if (!(length > slack_ * slack_)) return false;  // the two directions are parallel, or one of them has no length
    Projection pair, other;
    pair.add(from, axis);
    pair.add(to, axis);
    other.add(blocker, axis);
    return other.low >= pair.high - slack_ * length || other.high <= pair.low + slack_ * length;
  };
  for (const Vec3& p : from.vertices()) {
    for (const Vec3& q : to.vertices()) {
      const Vec3 joining = q - p;
      for (const Polygon* polygon : {&blocker, &from, &to}) {
        const auto& v = polygon->vertices();
        for (std::size_t k = 0; k < v.size(); ++k) {
          if (separates(joining.cross(v[(k + 1) % v.size()] - v[k]))) return true;
        }
      }
    }
  }
  return false;
}

// The lines between corners cross the face's plane inside the face: then so do all lines between the two (NOTES.md §1).
bool SightMap::hides_all(std::size_t face, std::size_t first, std::size_t second) const {
  const Range& a = heights_[face * mesh_.elements.size() + first];
  const Range& b = heights_[face * mesh_.elements.size() + second];
  if (!(a.high < -slack_ && b.low > slack_) && !(a.low > slack_ && b.high < -slack_)) return false;
  const Polygon& blocker = mesh_.faces[face].polygon;
  const auto& v = blocker.vertices();
  for (const Vec3& p : mesh_.elements[first].polygon.vertices()) {
    const double p_height = height(blocker, p);
    for (const Vec3& q : mesh_.elements[second].polygon.vertices()) {
      const double q_height = height(blocker, q);
      const Vec3 crossing = (q_height * p - p_height * q) / (q_height - p_height);
      for (std::size_t k = 0; k < v.size(); ++k) {
        const Vec3 inward = blocker.normal().cross(v[(k + 1) % v.size()] - v[k]).normalized();
        if (inward.dot(crossing - v[k]) < slack_) return false;
      }
    }
  }
  return true;
}

}  // namespace etendue
