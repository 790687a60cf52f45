// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The points of a plane within `radius` of `centre`; `normal` is a unit vector.
struct Disc {
  Vec3 centre;
  Vec3 normal;
  double radius;
};

/// Where a ray meets a disc: where it meets the plane, if that is no farther than the radius from the centre.
///                                                                                                      @eq IU.5.0
/// Domain    as for Plane; radius > 0
/// Returns   as for Plane; uv: offset from the centre along tangent_frame(normal), in radii
/// Hits      the rim belongs to the disc; a meeting within point_error + 4 u radius of the rim may be decided either
/// way Accuracy  t within kPlaneUlps: proved Errors    ContractViolation as for Plane, and where the radius is not
/// positive Source    elementary
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Disc& disc);

}  // namespace etendue
