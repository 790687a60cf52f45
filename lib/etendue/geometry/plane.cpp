// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/plane.hpp"

#include "etendue/core/contract.hpp"
#include "etendue/geometry/meeting.hpp"

namespace etendue {

std::optional<Hit> intersect(const Ray& ray, const Plane& plane) {
  require_direction(ray);
  require(is_unit_normal(plane.normal), "intersect: the plane's normal is a unit vector");
  require(plane.point.allFinite(), "intersect: the plane's point is finite");
  const auto t = meet_plane(ray, plane.normal, plane.point);
  if (!t) return std::nullopt;
  Hit hit = flat_hit(ray, *t, plane.normal);
  const TangentFrame frame = tangent_frame(plane.normal);
  const Vec3 offset = hit.point - plane.point;
  hit.uv = {frame.u.dot(offset), frame.v.dot(offset)};
  return hit;
}

}  // namespace etendue
