// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// Corners in counter-clockwise order as seen from the front.
struct Triangle {
  Vec3 a, b, c;
};

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle);

}  // namespace etendue
