// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// The lateral surface of a finite right circular cylinder between the centres of its (open) ends.
struct Cylinder {
  Vec3 base;
  Vec3 top;
  double radius;
};

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Cylinder& cylinder);

}  // namespace etendue
