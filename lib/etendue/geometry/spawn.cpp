// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/spawn.hpp"

#include "etendue/core/rounding.hpp"

namespace etendue {

Vec3 offset_origin(const Hit& hit, const Vec3& direction) {
  // The move is rounded, too: by u |p + move| a component.
  const double distance = 2 * hit.surface_error + 2 * kUnitRoundoff * hit.point.lpNorm<1>();
  return hit.point + (direction.dot(hit.normal) < 0 ? -distance : distance) * hit.normal;
}

}  // namespace etendue
