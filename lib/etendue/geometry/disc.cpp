// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/disc.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/meeting.hpp"

namespace etendue {

std::optional<Hit> intersect(const Ray& ray, const Disc& disc) {
  require_direction(ray);
  require(is_unit_normal(disc.normal), "intersect: the disc's normal is a unit vector");
  require(disc.radius > 0 && std::isfinite(disc.radius), "intersect: the disc's radius is positive and finite");
  require(disc.centre.allFinite(), "intersect: the disc's centre is finite");
  const auto t = meet_plane(ray, disc.normal, disc.centre);
  if (!t) return std::nullopt;
  Hit hit = flat_hit(ray, *t, disc.normal);
  const Vec3 offset = hit.point - disc.centre;
  if (offset.squaredNorm() > disc.radius * disc.radius) return std::nullopt;
  const TangentFrame frame = tangent_frame(disc.normal);
  hit.uv = Vec2(frame.u.dot(offset), frame.v.dot(offset)) / disc.radius;
  return hit;
}

}  // namespace etendue
