// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/cone.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/torus.hpp"

namespace etendue {

/// A point of a surface that has coordinates of its own, Q(u, v), and its tangents there.
struct ChartPoint {
  double u = 0, v = 0;  ///< those of Hit::uv
  Vec3 along_u, along_v;  ///< ∂Q/∂u, ∂Q/∂v [length]; along_u × along_v points outward, and is zero at poles and apices
};

/// Where a point of a surface lies on it.                                                                  @eq IU.4.1.2
///
/// Domain    the point within a small part of the shape's radius of the surface, as on a net of triangles over it: it counts as
///           the nearest point in the plane of its meridian. Shapes as for their intersect()
/// Returns   u, v as Hit::uv of the shape; u in [0, 1)
/// Accuracy  u, v: a few roundings of the distances from axis and centre; tested against Hit::uv
/// Errors    none
[[nodiscard]] ChartPoint chart(const Sphere& sphere, const Vec3& point);
[[nodiscard]] ChartPoint chart(const Cylinder& cylinder, const Vec3& point);
[[nodiscard]] ChartPoint chart(const Cone& cone, const Vec3& point);
[[nodiscard]] ChartPoint chart(const Torus& torus, const Vec3& point);

}  // namespace etendue
