// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/near_line.hpp"

#include <cmath>

namespace etendue {

NearLine::NearLine(const Ray& ray, const Vec3& centre) {
  const DoubleDouble3 v = exact_difference(ray.origin, centre);
  const Vec3 far(v.x.high, v.y.high, v.z.high), &d = ray.direction;
  shift = -far.dot(d) / d.squaredNorm();
  start = {v.x + exact_product(shift, d.x()), v.y + exact_product(shift, d.y()), v.z + exact_product(shift, d.z())};
  // One sum of two numbers, each of them exact: NOTES.md §10.
  start_error = 0x1p-101 * far.lpNorm<Eigen::Infinity>() + 0x1p-101 * std::abs(shift) * d.lpNorm<Eigen::Infinity>();
  distance = Vec3(start.x.high, start.y.high, start.z.high).norm();
}

}  // namespace etendue
