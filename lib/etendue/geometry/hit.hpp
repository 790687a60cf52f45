// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Where a ray meets a surface. Bounds are proved in NOTES.md §3 to §7.
///
/// point_error compares with the meeting of the exact ray with the exact shape, surface_error only with the shape: far
/// rays lose digits along the surface before they lose them across it.
struct Hit {
  double t = 0;                 ///< parameter along the ray, in (t_min, t_max)
  Vec3 point = Vec3::Zero();    ///< the meeting point, projected onto the surface
  Vec3 normal = Vec3::UnitZ();  ///< geometric unit normal; points outward for closed shapes, never flipped to the ray
  Vec2 uv = Vec2::Zero();       ///< surface coordinates; each shape says which
  double point_error = 0;       ///< bound on |point − true meeting point|, in scene units
  double surface_error = 0;     ///< bound on the distance from `point` to the surface, as its intersect() sees it
};

}  // namespace etendue
