// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// det(a − x, b − x, c − x) for x in the plane z = 0: on which side of the plane over the edge from a to b the point c is
/// seen. Affine in x.
struct ViewSide {
  Vec2 gradient;
  double constant;
  double at(const Vec2& x) const { return constant + gradient.dot(x); }
};

[[nodiscard]] inline ViewSide view_side(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  return {-normal.head<2>(), normal.dot(c)};
}

}  // namespace etendue
