// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The points p with normal · (p − point) = 0; `normal` is a unit vector.
struct Plane {
  Vec3 point;
  Vec3 normal;
};

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Plane& plane);

}  // namespace etendue
