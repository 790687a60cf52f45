// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// A box: centre, three orthonormal axes (the columns of `axes`, right-handed) and half the edge along each.
struct Box {
  Vec3 centre;
  Mat3 axes = Mat3::Identity();
  Vec3 half_edges;
};

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Box& box);

}  // namespace etendue
