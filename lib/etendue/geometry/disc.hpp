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

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Disc& disc);

}  // namespace etendue
