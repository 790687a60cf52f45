// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// Corners in counter-clockwise order as seen from the front.                                   @eq RT.9, RT.10
struct Triangle {
  Vec3 a, b, c;
};

/// Hit or miss is decided exactly for a triangle whose corners are moved by at most this share of the largest
/// coordinate of corner − origin (NOTES.md §5).
inline constexpr double kTriangleShift = 0x1p-49;

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle);

}  // namespace etendue
