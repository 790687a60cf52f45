// SPDX-License-Identifier: Apache-2.0
#include "etendue/gather/final_gather.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/point_view.hpp"

namespace etendue {

namespace {

/// Sine of the largest angle at which a sensor still counts as facing along a surface's normal: what both lose in files
/// with seven digits.
constexpr double kAlongNormal = 0x1p-20;

/// Of the area; of less than an area, the mean of the corners.
Vec3 centroid(std::span<const Vec3> corners) {
  Vec3 mean = Vec3::Zero(), sum = Vec3::Zero(), newell = Vec3::Zero();
  const Vec3& base = corners[0];
  for (const Vec3& v : corners) mean += (v - base) / static_cast<double>(corners.size());
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) newell += (corners[k] - base).cross(corners[k + 1] - base);
  const double square = newell.squaredNorm();
  if (!(square > 0)) return base + mean;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vec3 a = corners[k] - base, b = corners[k + 1] - base;
    sum += a.cross(b).dot(newell) / square * (a + b) / 3;
  }
  return base + sum;
}

/// Where, in a part of an element, the mean of a linear function is its value, weighted as the point weighs it:
///     c + M γ,   M = 1/A ∫ (p − c)(p − c)ᵀ dA,   γ = ∇ ln (cos a_x cos a_j / r²) at c = n/(n·d) − 4d/d²,  d = c − x
/// to second order in the part's size over its distance. The centroid c, where the horizon cuts it.
Vec3 weighted_centre(const Vec3& point, const Vec3& normal, std::span<const Vec3> corners, const Vec3& centre) {
  const Vec3 to_centre = centre - point;
  const double height = normal.dot(to_centre);
  for (const Vec3& v : corners) {
    if (!(normal.dot(v - point) > 0)) return centre;
  }
  const Vec3 rise = normal / height - 4 / to_centre.squaredNorm() * to_centre;
  Vec3 moment = Vec3::Zero();  // M γ, over triangles around c: A/12 (Σ v vᵀ + (Σ v)(Σ v)ᵀ) with c for one v
  double area = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 a = corners[k] - centre, b = corners[(k + 1) % corners.size()] - centre, sum = a + b;
    const double twice = a.cross(b).norm();
    moment += twice * (a.dot(rise) * a + b.dot(rise) * b + sum.dot(rise) * sum);
    area += 12 * twice;
  }
  return area > 0 ? Vec3(centre + moment / area) : centre;
}

double greatest_distance(std::span<const Vec3> points, const Vec3& from) {
  double square = 0;
  for (const Vec3& p : points) square = std::max(square, (p - from).squaredNorm());
  return std::sqrt(square);
}

}  // namespace

struct FinalGather::Look {
  Look(const Vec3& from, const Vec3& along, std::vector<const Body*> in_the_way)
      : point(from), normal(along), bodies(std::move(in_the_way)), view(from, along, blockers_of(bodies)) {}
  static std::vector<const Blocker*> blockers_of(const std::vector<const Body*>& bodies) {
    std::vector<const Blocker*> blockers;
    for (const Body* body : bodies) blockers.push_back(body->blocker);
    return blockers;
  }
  const Vec3 &point, &normal;
  std::vector<const Body*> bodies;
  PointView view;
  double terms = 0;  ///< of the sum
};

FinalGather::FinalGather(const ElementMesh& mesh) : mesh_(mesh), sights_(mesh) {
  const std::size_t faces = mesh.faces.size();
  for (const Element& element : mesh.elements) {
    const Vec3& centre = element.polygon.centroid();
    balls_.push_back({centre, greatest_distance(element.polygon.vertices(), centre)});
  }
  for (std::size_t plane = 0; plane < faces; ++plane) {
    Sides all;
    for (const Face& face : mesh.faces) {
      Sides one;
      for (const Vec3& v : face.polygon.vertices()) {
        const double h = height(plane, v);
        one = {one.over || h > slack(), one.under || h < -slack()};
      }
      all = {all.over || one.over, all.under || one.under};
      sides_.push_back(one);
    }
    all_sides_.push_back(all);
  }
  std::vector<char> taken(faces, 0);
  for (SightMap::Solid& solid : sights_.solids()) {
    for (const std::size_t f : solid.faces) taken[f] = 1;
    add_body(solid.blocker, std::move(solid.faces));
  }
  plates_.reserve(faces);  // so that none moves
  for (std::size_t f = 0; f < faces; ++f) {
    if (taken[f] != 0) continue;
    plates_.push_back(Blocker::plate(mesh.faces[f].polygon));
    add_body(&plates_.back(), {f});
  }
}

void FinalGather::add_body(const Blocker* blocker, std::vector<std::size_t> faces) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : blocker->points()) centre += p / static_cast<double>(blocker->points().size());
  bodies_.push_back({blocker, std::move(faces), {centre, greatest_distance(blocker->points(), centre)}});
}

double FinalGather::height(std::size_t face, const Vec3& point) const {
  const Polygon& plane = mesh_.faces[face].polygon;
  return plane.normal().dot(point - plane.centroid());
}

// What has the point and all surfaces on one side of a plane of its own hides nothing.
std::vector<const FinalGather::Body*> FinalGather::in_the_way(const Vec3& point) const {
  std::vector<const Body*> found;
  for (const Body& body : bodies_) {
    const bool solid = body.blocker->is_solid();
    const auto clear = [&](std::size_t face) {
      const double h = height(face, point);
      if (h >= -slack() && !all_sides_[face].under) return true;
      return !solid && (std::abs(h) <= slack() || (h <= slack() && !all_sides_[face].over));
    };
    if (std::none_of(body.faces.begin(), body.faces.end(), clear)) found.push_back(&body);
  }
  return found;
}

bool FinalGather::may_hide(const Body& body, const Vec3& point, std::size_t element) const {
  const std::size_t own = mesh_.elements[element].face, faces = mesh_.faces.size();
  const bool solid = body.blocker->is_solid();
  for (const std::size_t face : body.faces) {
    const double h = height(face, point);
    const Sides& sides = sides_[face * faces + own];
    if (face == own && !solid) return false;
    // Both beyond the face, or both on one side of a plate.
    if (h >= -slack() && !sides.under) return false;
    if (!solid && h <= slack() && !sides.over) return false;
  }
  // Two balls that the point sees at an angle larger than both their radii are apart in its view.
  const Vec3 to_body = body.ball.centre - point, to_element = balls_[element].centre - point;
  const double far_body = to_body.norm(), far_element = to_element.norm();
  const double r_body = body.ball.radius + slack(), r_element = balls_[element].radius + slack();
  if (far_body <= r_body || far_element <= r_element) return true;
  if (far_body - r_body >= far_element + r_element) return false;  // behind the element
  const double angle = std::atan2(to_body.cross(to_element).norm(), to_body.dot(to_element));
  constexpr double kAngleRounding = 0x1p-40;  // of radians; a pair that is kept in vain costs time only
  return angle <= std::asin(r_body / far_body) + std::asin(r_element / far_element) + kAngleRounding;
}

bool FinalGather::crosses_plane(const Body& body, std::size_t element) const {
  const std::size_t own = mesh_.elements[element].face, faces = mesh_.faces.size();
  return std::any_of(body.faces.begin(), body.faces.end(),
                     [&](std::size_t face) { return sides_[own * faces + face].under; });
}

std::optional<FinalGather::Obstacle> FinalGather::obstacle(const Vec3& point, const Vec3& normal) const {
  const auto object_of = [&](std::size_t face) { return mesh_.faces[face].object; };
  for (const Body& body : bodies_) {
    const auto under = [&](std::size_t face) { return height(face, point) < -slack(); };
    if (body.blocker->is_solid() && std::all_of(body.faces.begin(), body.faces.end(), under)) {
      return Obstacle{Obstacle::Kind::inside, object_of(body.faces.front())};
    }
  }
  for (const Body& body : bodies_) {
    for (const std::size_t face : body.faces) {
      if (!is_on(face, point)) continue;
      const Vec3& its = mesh_.faces[face].polygon.normal();
      if (its.cross(normal).norm() > kAlongNormal) return Obstacle{Obstacle::Kind::oblique, object_of(face)};
      if (body.blocker->is_solid() && its.dot(normal) < 0) return Obstacle{Obstacle::Kind::facing_in, object_of(face)};
    }
  }
  return std::nullopt;
}

bool FinalGather::is_on(std::size_t face, const Vec3& point) const {
  if (std::abs(height(face, point)) > slack()) return false;
  const Polygon& polygon = mesh_.faces[face].polygon;
  const std::vector<Vec3>& v = polygon.vertices();
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Vec3 inwards = polygon.normal().cross(v[(k + 1) % v.size()] - v[k]).normalized();
    if (inwards.dot(point - v[k]) < -slack()) return false;
  }
  return true;
}

bool FinalGather::aim(const Look& look, std::size_t element, Target& target) const {
  const Polygon& polygon = mesh_.elements[element].polygon;
  if (look.normal.dot(balls_[element].centre - look.point) <= -balls_[element].radius - slack()) return false;
  if (polygon.normal().dot(look.point - polygon.centroid()) <= slack()) return false;
  target.element = element;
  target.hiding.clear();
  target.blockers.clear();
  bool crosses = false;
  for (std::size_t b = 0; b < look.bodies.size(); ++b) {
    if (!may_hide(*look.bodies[b], look.point, element)) continue;
    target.hiding.push_back(b);
    crosses = crosses || crosses_plane(*look.bodies[b], element);
  }
  if (!crosses) return true;
  for (const std::size_t b : target.hiding) target.blockers.push_back(look.bodies[b]->blocker);
  return true;
}

// Nothing where the corners are too close together for a polygon, which only a blocker across its plane asks for.
std::optional<Bounded> FinalGather::seen(Look& look, const Target& target, std::span<const Vec3> corners) const {
  if (target.blockers.empty()) return look.view.factor(corners, target.hiding);
  const auto polygon = Polygon::make({corners.begin(), corners.end()});
  if (!polygon) return std::nullopt;
  return visible_point_to_polygon(look.point, look.normal, *polygon, target.blockers);
}

std::vector<ElementFactor> FinalGather::factors(const Vec3& point, const Vec3& normal) const {
  Look look(point, normal, in_the_way(point));
  std::vector<ElementFactor> found;
  Target target;
  for (std::size_t k = 0; k < mesh_.elements.size(); ++k) {
    if (!aim(look, k, target)) continue;
    const std::optional<Bounded> factor = seen(look, target, mesh_.elements[k].polygon.vertices());
    if (factor && (factor->value > 0 || factor->bound > 0)) found.push_back({k, *factor});
  }
  return found;
}

void FinalGather::add(Look& look, const Target& target, const RadiosityField& field, std::span<const Vec3> corners,
                      int quarterings, Gathered& sum) const {
  const std::size_t element = target.element, n = corners.size();
  const Vec3 centre = centroid(corners);
  const bool varies = field.spread[element] > 0;
  if (varies && quarterings < kMostNearQuarterings &&
      greatest_distance(corners, centre) > kNearShare * (centre - look.point).norm()) {
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 &before = corners[(k + n - 1) % n], &corner = corners[k], &after = corners[(k + 1) % n];
      const std::array<Vec3, 4> part{(before + corner) / 2, corner, (corner + after) / 2, centre};
      add(look, target, field, part, quarterings + 1, sum);
    }
    return;
  }
  const std::optional<Bounded> factor = seen(look, target, corners);
  if (!factor || (factor->value == 0 && factor->bound == 0)) return;
  Vec3 from_centroid = Vec3::Zero();
  if (varies) {
    from_centroid =
        weighted_centre(look.point, look.normal, corners, centre) - mesh_.elements[element].polygon.centroid();
  }
  const Rgb value = field.at(element, from_centroid), error = field.bound_at(element, from_centroid);
  sum.irradiance += factor->value * value;
  sum.bound += factor->value * error + factor->bound * (value + error);
  ++look.terms;
}

Gathered FinalGather::irradiance(const Vec3& point, const Vec3& normal, const RadiosityField& field) const {
  require(field.value.size() == mesh_.elements.size(), "irradiance: the field is of this mesh");
  Look look(point, normal, in_the_way(point));
  Gathered sum;
  Target target;
  for (std::size_t k = 0; k < mesh_.elements.size(); ++k) {
    if ((field.value[k] == 0).all() && (field.bound == 0).all()) continue;
    if (aim(look, k, target)) add(look, target, field, mesh_.elements[k].polygon.vertices(), 0, sum);
  }
  // A product and a sum each, of terms that are not negative; as many in the bound.
  const double rounding = (2 * look.terms + 8) * kUnitRoundoff;
  sum.bound = (sum.bound + rounding * sum.irradiance) * (1 + rounding);
  return sum;
}

}  // namespace etendue
