// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/polygon_with_holes.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "etendue/geometry/extent.hpp"
#include "etendue/geometry/jordan.hpp"
#include "etendue/geometry/newell.hpp"
#include "etendue/geometry/polygon_meeting.hpp"
#include "etendue/geometry/predicates.hpp"
#include "etendue/geometry/vector_text.hpp"

namespace etendue {

namespace {

using Chain = std::vector<Vec3>;

Error refusal(const std::string& what) {
  return {ErrorCode::invalid_input, "polygon: " + what};
}

/// Which edges of two chains in one plane have a point in common.
std::optional<std::pair<std::size_t, std::size_t>> meeting_edges(const Chain& a, const Chain& b, int axis) {
  const auto corner = [axis](const Chain& chain, std::size_t i) { return projected(chain[i % chain.size()], axis); };
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (segments_meet(corner(a, i), corner(a, i + 1), corner(b, j), corner(b, j + 1))) return std::pair(i, j);
    }
  }
  return std::nullopt;
}

std::string edge_text(const Chain& chain, std::size_t i) {
  return text(chain[i]) + " to " + text(chain[(i + 1) % chain.size()]);
}

std::optional<Error> crossing(const std::string& first, const Chain& a, const std::string& second, const Chain& b,
                              int axis) {
  const auto edges = meeting_edges(a, b, axis);
  if (!edges) return std::nullopt;
  return refusal(first + " crosses or touches " + second + ": edges " + edge_text(a, edges->first) + " and " +
                 edge_text(b, edges->second));
}

}  // namespace

Result<PolygonWithHoles> PolygonWithHoles::make(Polygon outline, std::vector<std::vector<Vec3>> holes) {
  PolygonWithHoles made(std::move(outline));
  const Polygon& around = made.outline_;
  const int axis = dominant_axis(around.normal());
  const Extent extent = extent_of(around.vertices());
  const double allowed = kPlanarity * extent.size + kCoordinateRounding * extent.coordinate;
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const std::string name = "hole " + std::to_string(k);
    const auto hole = Polygon::make(holes[k]);
    if (!hole) {
      const std::string& why = hole.error().message;  // "polygon: what is wrong"
      return refusal(name + ": " + why.substr(why.find(' ') + 1));
    }
    for (std::size_t i = 0; i < holes[k].size(); ++i) {
      const double distance = std::abs(around.normal().dot(holes[k][i] - around.centroid()));
      if (distance <= allowed) continue;
      return refusal(name + ": vertex " + std::to_string(i) + " = " + text(holes[k][i]) + " is " +
                     short_text(distance) + " off the polygon's plane; " + short_text(allowed) + " is allowed");
    }
    if (auto error = crossing(name, holes[k], "the outline", around.vertices(), axis)) return *error;
    if (!encloses(around.vertices(), holes[k][0], axis)) return refusal(name + " lies outside the polygon");
    for (std::size_t other = 0; other < k; ++other) {
      const std::string its_name = "hole " + std::to_string(other);
      if (auto error = crossing(name, holes[k], its_name, holes[other], axis)) return *error;
      if (encloses(holes[other], holes[k][0], axis)) return refusal(name + " lies within " + its_name);
      if (encloses(holes[k], holes[other][0], axis)) return refusal(its_name + " lies within " + name);
    }
    made.area_ -= hole->area();
  }
  made.holes_ = std::move(holes);
  return made;
}

std::optional<Hit> intersect(const Ray& ray, const PolygonWithHoles& polygon) {
  require_direction(ray);
  const Shear shear = shear_of(ray.direction);
  bool inside = passes_through(shear, ray.origin, polygon.outline().vertices());
  for (const Chain& hole : polygon.holes()) inside = inside != passes_through(shear, ray.origin, hole);
  return inside ? hit_of_plane(ray, polygon.outline()) : std::nullopt;
}

}  // namespace etendue
