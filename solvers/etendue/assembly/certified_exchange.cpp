// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/certified_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

Bounded middle(const Interval& exchange) {
  const double value = exchange.middle();
  return {value, above(std::max(above(exchange.upper - value), above(value - exchange.lower)))};
}

/// Power of two that brings the largest coordinate to order one: ExactPlane wants that.
double scale_of(const ElementMesh& mesh) {
  double largest = 0;
  for (const Face& face : mesh.faces) {
    for (const Vec3& v : face.polygon.vertices()) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  }
  return largest > 0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1;
}

const char* name(EnclosedBy by) {
  switch (by) {
    case EnclosedBy::integration:
      return "integration";
    case EnclosedBy::event_lines:
      return "event lines";
    case EnclosedBy::shadow_hulls:
      return "shadow hulls";
  }
  return "";
}

}  // namespace

CertifiedExchange::CertifiedExchange(const ElementMesh& mesh, const Tolerance& tolerance)
    : CertifiedExchange(mesh, CertifiedGoal{with_room(tolerance)}, CertifiedGoal{with_room(tolerance)}) {}

CertifiedExchange::CertifiedExchange(const ElementMesh& mesh, const CertifiedGoal& free,
                                     const CertifiedGoal& obstructed)
    : mesh_(mesh), goals_{free, obstructed} {
  const auto bounds_of = [](const Polygon& polygon) {
    Bounds bounds{polygon.vertices().front(), polygon.vertices().front()};
    for (const Vec3& vertex : polygon.vertices()) {
      bounds.low = bounds.low.cwiseMin(vertex);
      bounds.high = bounds.high.cwiseMax(vertex);
    }
    return bounds;
  };
  for (const Face& face : mesh.faces) face_bounds_.push_back(bounds_of(face.polygon));
  const double scale = scale_of(mesh);
  const Interval back = Interval(1) / Interval(scale);  // a power of two: exact
  for (const Element& element : mesh.elements) {
    element_bounds_.push_back(bounds_of(element.polygon));
    const ExactPlane plane(scaled(element.polygon.vertices(), scale));
    areas_.push_back(Interval(0.5) * norm(plane.normal()) * back * back);
  }
  heights_.reserve(mesh.faces.size() * mesh.elements.size());
  for (const Face& face : mesh.faces) {
    const ExactPlane plane(scaled(face.polygon.vertices(), scale));
    for (const Element& element : mesh.elements) {
      const std::vector<Vec3> corners = scaled(element.polygon.vertices(), scale);
      Interval range = plane.height(corners.front());
      for (const Vec3& v : corners) range = hull(range, plane.height(v));
      heights_.push_back(range);
    }
  }
}

bool CertifiedExchange::may_block(std::size_t face, const SurfacePair& pair) const {
  if (face == mesh_.elements[pair.i].face || face == mesh_.elements[pair.j].face) return false;
  const Interval& a = heights_[face * mesh_.elements.size() + pair.i];
  const Interval& b = heights_[face * mesh_.elements.size() + pair.j];
  if (std::min(a.lower, b.lower) >= 0 || std::max(a.upper, b.upper) <= 0) return false;
  const Bounds &first = element_bounds_[pair.i], &second = element_bounds_[pair.j], &own = face_bounds_[face];
  for (int axis = 0; axis < 3; ++axis) {
    if (own.low(axis) >= std::max(first.high(axis), second.high(axis))) return false;
    if (own.high(axis) <= std::min(first.low(axis), second.low(axis))) return false;
  }
  return true;
}

EnclosedExchange CertifiedExchange::enclosed(const SurfacePair& pair) const {
  const Polygon& first = mesh_.elements[pair.i].polygon;
  const Polygon& second = mesh_.elements[pair.j].polygon;
  std::vector<Polygon> faces;
  for (std::size_t face = 0; face < mesh_.faces.size(); ++face) {
    if (may_block(face, pair)) faces.push_back(mesh_.faces[face].polygon);
  }
  // So that an absolute error holds for the factor from either side: it is larger from the smaller surface.
  const double ratio = std::min(first.area(), second.area()) / std::max(first.area(), second.area());
  CertifiedGoal goal = faces.empty() ? goals_.free : goals_.obstructed;
  goal.tolerance.absolute *= ratio;
  EnclosedExchange result;
  result.factor = certified_form_factor(first, second, faces, goal);
  result.averted = result.factor.factor.is_zero() && result.factor.work == 0;
  result.obstructed = result.factor.blockers > 0;
  if (!faces.empty() && !result.obstructed && !result.averted) {
    // All were shown to stay out of the way: more is asked of free pairs.
    goal = goals_.free;
    goal.tolerance.absolute *= ratio;
    result.factor = certified_form_factor(first, second, faces, goal);
  }
  const Interval flux = result.factor.factor * areas_[pair.i];
  // A_i F_ij ≤ A_j holds for the truth.
  result.exchange = {std::max(0.0, flux.lower), std::min(flux.upper, areas_[pair.j].upper)};
  return result;
}

void CertifiedExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges,
                             TileReport& report) const {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const EnclosedExchange found = enclosed(pairs[k]);
    if (found.averted) {
      ++report.averted;
    } else if (found.obstructed) {
      ++report.obstructed;
    } else {
      ++report.clear;
    }
    exchanges[k] = middle(found.exchange);
  }
}

std::vector<std::size_t> CertifiedExchange::blockers(const SurfacePair& pair) const {
  std::vector<std::size_t> faces;
  if (!enclosed(pair).obstructed) return faces;
  for (std::size_t face = 0; face < mesh_.faces.size(); ++face) {
    if (may_block(face, pair)) faces.push_back(face);
  }
  return faces;
}

std::string CertifiedExchange::manner(const SurfacePair& pair) const {
  const EnclosedExchange found = enclosed(pair);
  return found.averted ? "certainly zero" : name(found.factor.by);
}

}  // namespace etendue
