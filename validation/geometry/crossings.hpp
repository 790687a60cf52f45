// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue::validation {

struct Crossings {
  long count = 0;
  double off = 0;  ///< how far hits are off the shape, at most, as a share of max(1, way of the ray)
};

/// The crossings of a ray with a shape, one after the other: each search begins where the last hit was (t_min), so that one
/// crossing twice would be counted twice. Ends beyond `most`. `distance` says how far a point is off the shape.
template <class Shape, class Distance>
Crossings crossings(Ray ray, const Shape& shape, long most, const Distance& distance) {
  Crossings found;
  while (found.count <= most) {
    const auto hit = intersect(ray, shape);
    if (!hit) break;
    ++found.count;
    ray.t_min = hit->t;
    found.off = std::max(found.off, distance(hit->point) / std::max(1.0, (hit->point - ray.origin).norm()));
  }
  return found;
}

}  // namespace etendue::validation
