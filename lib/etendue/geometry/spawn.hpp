// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/hit.hpp"

namespace etendue {

/// Where a ray that leaves the surface at `hit` into `direction` starts: the hit's point, moved along the normal to the
/// side of `direction`, as far as the hit's own error reaches and no farther.                         @eq IU.5.4b, G8
///
/// Domain    a hit made by one of our intersect(); any direction, of any length
/// Returns   a point at a distance of 2 surface_error + 2 u |point|_1 from the hit's. From there, a ray into
/// `direction` does
///           not meet the same plane, disc, polygon, triangle, box again, nor a sphere or cylinder from outside:
///           proved, NOTES.md §8. What is twice as far away is still met
/// Errors    none
/// Source    Wächter and Binder 2019 for the idea; the distance is our own bound
[[nodiscard]] Vec3 offset_origin(const Hit& hit, const Vec3& direction);

}  // namespace etendue
