// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/predicates.hpp"
#include "etendue/geometry/vector.hpp"

// What the watertight intersections share; their users want triangle.hpp, polygon.hpp.
namespace etendue {

/// The ray turned into the z axis: axes permuted so that z is the direction's largest component, then sheared.
/// Two shapes see the same corner at the same doubles, and so agree on every edge they share (NOTES.md §5).
/// Source    Woop, Benthin and Wald 2013
struct Shear {
  int x, y, z;
  double along_x, along_y, scale;
};

/// A corner so seen: (x, y) across the ray, z along it, in units of the direction.
struct Sheared {
  double x, y, z;
};

[[nodiscard]] inline Shear shear_of(const Vec3& direction) {
  int z = 0;
  direction.cwiseAbs().maxCoeff(&z);
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  return {x, y, z, direction[x] / direction[z], direction[y] / direction[z], 1 / direction[z]};
}

[[nodiscard]] inline Sheared sheared(const Shear& shear, const Vec3& corner, const Vec3& origin) {
  const double x = corner[shear.x] - origin[shear.x], y = corner[shear.y] - origin[shear.y];
  const double z = corner[shear.z] - origin[shear.z];
  return {x - shear.along_x * z, y - shear.along_y * z, shear.scale * z};
}

/// Twice the signed area of (0, p, q). The two products are rounded separately, so the value changes its sign and
/// nothing else when p and q change places, and its sign is wrong only by being 0, which is then decided exactly: two
/// neighbours agree on their common edge. Contraction of either product destroys both properties.
[[nodiscard]] inline double edge_function(const Sheared& p, const Sheared& q) {
  const double value = p.x * q.y - p.y * q.x;
  if (value != 0) return value;
  return difference_of_products(p.x, q.y, p.y, q.x);
}

}  // namespace etendue
