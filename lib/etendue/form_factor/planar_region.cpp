// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/planar_region.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

#include "etendue/form_factor/point_polygon.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "etendue/geometry/extent.hpp"
#include "etendue/geometry/jordan.hpp"
#include "etendue/geometry/newell.hpp"
#include "etendue/geometry/predicates.hpp"
#include "etendue/geometry/vector_text.hpp"

namespace etendue {

namespace {

Error refusal(std::size_t hole, const std::string& what) {
  return {ErrorCode::invalid_input, "region: hole " + std::to_string(hole) + " " + what};
}

/// The first edge of `a` that meets an edge of `b`, or the number of its edges.
std::size_t meeting_edge(const std::vector<Vec3>& a, const std::vector<Vec3>& b, int axis) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 p = projected(a[i], axis), q = projected(a[(i + 1) % a.size()], axis);
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (segments_meet(p, q, projected(b[j], axis), projected(b[(j + 1) % b.size()], axis))) return i;
    }
  }
  return a.size();
}

}  // namespace

PlanarRegion::PlanarRegion(const Polygon& outline)
    : boundary_{outline.vertices()}, normal_(outline.normal()), area_(outline.area()) {}

Result<PlanarRegion> PlanarRegion::make(const Polygon& outline, const std::vector<std::vector<Vec3>>& holes) {
  PlanarRegion region(outline);
  const auto& frame = outline.vertices();
  const int axis = dominant_axis(outline.normal());
  const Extent extent = extent_of(frame);
  const double allowed = kPlanarity * extent.size + kCoordinateRounding * extent.coordinate;
  for (std::size_t h = 0; h < holes.size(); ++h) {
    const Result<Polygon> hole = Polygon::make(holes[h]);
    if (!hole) return refusal(h, "is no polygon: " + hole.error().message);
    if (hole->normal().dot(outline.normal()) > 0) {
      return refusal(h, "runs counter-clockwise as seen from the front of the outline; holes run clockwise");
    }
    for (std::size_t i = 0; i < holes[h].size(); ++i) {
      const Vec3& v = holes[h][i];
      const double off = std::abs(outline.normal().dot(v - outline.centroid()));
      if (off > allowed) {
        return refusal(h, "leaves the outline's plane: vertex " + std::to_string(i) + " = " + text(v) + " is " +
                              std::to_string(off) + " off it");
      }
      if (!encloses(frame, v, axis)) {
        return refusal(h, "is not inside the outline: vertex " + std::to_string(i) + " = " + text(v));
      }
    }
    const std::size_t crossing = meeting_edge(holes[h], frame, axis);
    if (crossing < holes[h].size()) {
      return refusal(h, "meets the outline with the edge from vertex " + std::to_string(crossing) + " = " +
                            text(holes[h][crossing]));
    }
    for (std::size_t other = 0; other < h; ++other) {
      const std::size_t edge = meeting_edge(holes[h], holes[other], axis);
      const bool nested =
          encloses(holes[other], holes[h].front(), axis) || encloses(holes[h], holes[other].front(), axis);
      if (edge == holes[h].size() && !nested) continue;
      return refusal(h, "meets hole " + std::to_string(other) + " near vertex " + std::to_string(nested ? 0 : edge) +
                            " = " + text(holes[h][nested ? 0 : edge]));
    }
    region.area_ -= hole->area();
    region.boundary_.push_back(holes[h]);
  }
  return region;
}

Bounded form_factor(const PlanarRegion& from, const PlanarRegion& to, Tolerance tolerance) {
  return form_factor(from.boundary(), to.boundary(), tolerance);
}

Bounded point_to_region(const Vec3& point, const Vec3& normal, const PlanarRegion& region) {
  return point_to_boundary(point, normal, region.boundary());
}

}  // namespace etendue
