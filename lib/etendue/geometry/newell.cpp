// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/newell.hpp"

namespace etendue {

DoubleDouble3 newell_sum(const std::vector<Vec3>& vertices) {
  DoubleDouble3 sum;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const DoubleDouble3 term =
        cross(exact_difference(vertices[i], vertices[0]), exact_difference(vertices[i + 1], vertices[0]));
    sum = {sum.x + term.x, sum.y + term.y, sum.z + term.z};
  }
  return sum;
}

Expansion exact_newell_height(const std::vector<Vec3>& vertices, const Vec3& point) {
  const Vec3& origin = vertices.front();
  const auto from_origin = [&](const Vec3& p, int axis) { return exact_difference(p[axis], origin[axis]); };
  Expansion sum;
  for (int axis = 0; axis < 3; ++axis) {
    if (point[axis] == origin[axis]) continue;
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    Expansion normal;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
      const Vec3 &a = vertices[i], &b = vertices[i + 1];
      // In a plane across an axis, where exact heights are wanted most, all of these products are zero.
      if (a[next] != origin[next] && b[last] != origin[last])
        normal.add_product(from_origin(a, next), from_origin(b, last));
      if (a[last] != origin[last] && b[next] != origin[next])
        normal.add_product(-from_origin(a, last), from_origin(b, next));
    }
    sum = sum + normal * Expansion(from_origin(point, axis));
  }
  return sum;
}

int dominant_axis(const Vec3& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return axis;
}

}  // namespace etendue
