// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/spawn.hpp"

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/predicates.hpp"

namespace etendue {

Vec3 offset_origin(const Hit& hit, const Vec3& direction) {
  // The move is rounded, too: by u |p + move| a component.
  const double distance = 2 * hit.surface_error + 2 * kUnitRoundoff * hit.point.lpNorm<1>();
  // Exact: a direction that grazes within rounding would else start on one side and lead to the other.
  const bool behind = side(direction, Plane{Vec3::Zero(), hit.normal}) < 0;
  return hit.point + (behind ? -distance : distance) * hit.normal;
}

}  // namespace etendue
