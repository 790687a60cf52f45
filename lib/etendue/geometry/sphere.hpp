// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/core/result.hpp"
#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

struct Sphere {
  Vec3 centre;
  double radius;
};

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Sphere& sphere);

}  // namespace etendue
