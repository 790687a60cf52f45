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

int dominant_axis(const Vec3& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return axis;
}

}  // namespace etendue
