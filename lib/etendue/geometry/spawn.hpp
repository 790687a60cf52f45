// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/hit.hpp"

namespace etendue {

/// Where a ray that leaves the surface at `hit` into `direction` starts: the hit's point, moved along the normal to the
/// side of `direction`, as far as the hit's own error reaches and no farther.                  @eq IU.5.4b, G8
[[nodiscard]] Vec3 offset_origin(const Hit& hit, const Vec3& direction);

}  // namespace etendue
