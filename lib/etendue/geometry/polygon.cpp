// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/extent.hpp"
#include "etendue/geometry/jordan.hpp"
#include "etendue/geometry/kept_near.hpp"
#include "etendue/geometry/newell.hpp"
#include "etendue/geometry/polygon_meeting.hpp"
#include "etendue/geometry/predicates.hpp"
#include "etendue/geometry/triangle.hpp"
#include "etendue/geometry/vector_text.hpp"

namespace etendue {

std::string short_text(double value) {
  std::ostringstream out;
  out.precision(6);
  out << value;
  return out.str();
}

namespace {

Error refusal(const std::string& what) {
  return {ErrorCode::invalid_input, "polygon: " + what};
}

std::optional<Error> bad_vertex(const std::vector<Vec3>& vertices) {
  const std::size_t n = vertices.size();
  if (n < 3) return refusal("has " + std::to_string(n) + " vertices; at least 3 are needed");
  for (std::size_t i = 0; i < n; ++i) {
    if (!vertices[i].allFinite()) {
      return refusal("vertex " + std::to_string(i) + " = " + text(vertices[i]) + " is not finite");
    }
    if (vertices[i].lpNorm<Eigen::Infinity>() > kGreatestCoordinate) {
      return refusal("vertex " + std::to_string(i) + " = " + text(vertices[i]) +
                     " lies beyond 2^200 = " + short_text(kGreatestCoordinate) + "; the area could overflow");
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    if (vertices[i] == vertices[j]) {
      return refusal("vertices " + std::to_string(i) + " and " + std::to_string(j) + " coincide at " +
                     text(vertices[i]));
    }
    const double edge = (vertices[j] - vertices[i]).lpNorm<Eigen::Infinity>();
    if (edge < kLeastEdge) {
      return refusal("edge " + std::to_string(i) + "-" + std::to_string(j) + " at " + text(vertices[i]) + " is " +
                     short_text(edge) + " long, less than 2^-200 = " + short_text(kLeastEdge) +
                     "; the area would lose digits");
    }
  }
  return std::nullopt;
}

// Does the edge that arrives at `corner` from `before` turn back over itself towards `after`?
bool folds_back(const Vec2& before, const Vec2& corner, const Vec2& after) {
  if (orientation(before, corner, after) != 0) return false;
  // Collinear: it folds back iff both neighbours lie on one side, which one coordinate that changes can tell.
  const int axis = before.x() != corner.x() ? 0 : 1;
  return (before[axis] > corner[axis]) == (after[axis] > corner[axis]);
}

std::optional<Error> bad_chain(const std::vector<Vec3>& vertices, int axis) {
  const std::size_t n = vertices.size();
  const auto corner = [&](std::size_t i) { return projected(vertices[i % n], axis); };
  const auto edge = [&](std::size_t i) { return std::to_string(i) + "-" + std::to_string((i + 1) % n); };
  for (std::size_t i = 0; i < n; ++i) {
    if (folds_back(corner(i), corner(i + 1), corner(i + 2))) {
      return refusal("edges " + edge(i) + " and " + edge((i + 1) % n) + " fold back at vertex " +
                     std::to_string((i + 1) % n) + " = " + text(vertices[(i + 1) % n]));
    }
    for (std::size_t j = i + 2; j < n && (j + 1) % n != i; ++j) {
      if (segments_meet(corner(i), corner(i + 1), corner(j), corner(j + 1))) {
        return refusal("edges " + edge(i) + " " + text(vertices[i]) + " to " + text(vertices[(i + 1) % n]) + " and " +
                       edge(j) + " " + text(vertices[j]) + " to " + text(vertices[(j + 1) % n]) + " cross or touch");
      }
    }
  }
  return std::nullopt;
}

// Vertices whose signed areas cancel, as a bow tie's do, have no normal of Newell's; but where they lie in a plane, and
// not on a line, edges must meet: which?
std::optional<Error> crossing_without_area(const std::vector<Vec3>& vertices, double allowed) {
  const auto offset = [&](const Vec3& v) -> Vec3 { return v - vertices[0]; };
  const auto nearer = [&](const Vec3& a, const Vec3& b) { return offset(a).norm() < offset(b).norm(); };
  const Vec3 along = offset(*std::max_element(vertices.begin(), vertices.end(), nearer));
  Vec3 across = Vec3::Zero();
  for (const Vec3& v : vertices) {
    const Vec3 product = along.cross(offset(v));
    if (product.norm() > across.norm()) across = product;
  }
  if (!(across.norm() > allowed * along.norm())) return std::nullopt;  // on a line
  const Vec3 normal = across.normalized();
  for (const Vec3& v : vertices) {
    if (!(std::abs(normal.dot(offset(v))) <= allowed)) return std::nullopt;
  }
  return bad_chain(vertices, dominant_axis(normal));
}

// Σ_i a_i (v_0 + v_i + v_{i+1}) / 3 over the fan from vertex 0, a_i the signed areas.
Vec3 area_centroid(const std::vector<Vec3>& vertices, const Vec3& normal) {
  Vec3 moment = Vec3::Zero();
  double weight = 0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const Vec3 p = vertices[i] - vertices[0], q = vertices[i + 1] - vertices[0];
    const double area = normal.dot(p.cross(q));
    moment += area * (p + q);
    weight += area;
  }
  return vertices[0] + moment / (3 * weight);
}

}  // namespace

Result<Polygon> Polygon::make(std::vector<Vec3> vertices) {
  if (auto error = bad_vertex(vertices)) return *error;
  const Extent extent = extent_of(vertices);
  const DoubleDouble3 sum = newell_sum(vertices);
  const Vec3 twice_area(rounded(sum.x), rounded(sum.y), rounded(sum.z));
  Polygon polygon;
  polygon.area_ = twice_area.norm() / 2;
  const double allowed = kPlanarity * extent.size + kCoordinateRounding * extent.coordinate;
  if (polygon.area_ <= kNarrowest * extent.coordinate * extent.size) {
    if (auto crossing = crossing_without_area(vertices, allowed)) return *crossing;
    return refusal("has no area: its vertices lie on one line, to the rounding of coordinates as large as " +
                   short_text(extent.coordinate));
  }
  polygon.normal_ = twice_area.normalized();
  polygon.centroid_ = area_centroid(vertices, polygon.normal_);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double distance = std::abs(polygon.normal_.dot(vertices[i] - polygon.centroid_));
    if (!(distance <= allowed)) {
      return refusal("vertex " + std::to_string(i) + " = " + text(vertices[i]) + " is " + short_text(distance) +
                     " off the plane; " + short_text(allowed) + " is allowed (use triangles)");
    }
  }
  if (auto error = bad_chain(vertices, dominant_axis(polygon.normal_))) return *error;
  polygon.vertices_ = std::move(vertices);
  return polygon;
}

bool passes_through(const Shear& shear, const Vec3& origin, const std::vector<Vec3>& chain) {
  bool inside = false;
  Sheared previous = sheared(shear, chain.back(), origin);
  for (const Vec3& vertex : chain) {
    const Sheared current = sheared(shear, vertex, origin);
    const bool current_above = current.y >= 0;
    if ((previous.y >= 0) != current_above) {
      const double turn = edge_function(previous, current);
      if (current_above ? turn > 0 : turn < 0) inside = !inside;
    }
    previous = current;
  }
  return inside;
}

namespace {

double farthest_vertex(const Polygon& polygon, const Vec3& point) {
  double farthest = 0;
  for (const Vec3& v : polygon.vertices()) farthest = std::max(farthest, (v - point).lpNorm<Eigen::Infinity>());
  return farthest;
}

struct Span {
  Vec3 low, high;
};
Span span_of(const Polygon& polygon) {
  Span span{polygon.vertices()[0], polygon.vertices()[0]};
  for (const Vec3& v : polygon.vertices()) {
    span.low = span.low.cwiseMin(v);
    span.high = span.high.cwiseMax(v);
  }
  return span;
}

// The shift of the shear, and what a vertex may lie off the plane in which t is found.
double room_around(const Polygon& polygon, const Vec3& origin) {
  const Extent extent = extent_of(polygon.vertices());
  return kTriangleShift * farthest_vertex(polygon, origin) + kPlanarity * extent.size +
         kCoordinateRounding * extent.coordinate;
}

}  // namespace

std::optional<Hit> hit_of_plane(const Ray& ray, const Polygon& polygon) {
  const auto met = line_meets_plane(ray, polygon.normal(), polygon.centroid());
  if (!met) return std::nullopt;
  const auto [low, high] = span_of(polygon);
  const DoubleDouble t = kept_near(ray, *met, low, high, room_around(polygon, ray.origin));
  if (!looks_at(ray, t.high)) return std::nullopt;
  Hit hit = flat_hit(ray, t, polygon.normal());
  hit.point_error += std::abs(met->high - t.high) * ray.direction.norm();
  hit.surface_error += kTriangleShift * farthest_vertex(polygon, hit.point);
  const Vec3 along = (polygon.vertices()[1] - polygon.vertices()[0]).normalized();
  const Vec3 offset = hit.point - polygon.vertices()[0];
  hit.uv = {along.dot(offset), polygon.normal().cross(along).dot(offset)};
  return hit;
}

std::optional<Hit> intersect(const Ray& ray, const Polygon& polygon) {
  require_direction(ray);
  if (!passes_through(shear_of(ray.direction), ray.origin, polygon.vertices())) return std::nullopt;
  return hit_of_plane(ray, polygon);
}

}  // namespace etendue
