// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/reflect.hpp"

#include "etendue/core/contract.hpp"
#include "etendue/optics/unit.hpp"

namespace etendue {

Vec3 reflect(const Vec3& direction, const Vec3& normal) {
  require(is_unit(direction), "reflect: direction is a unit vector");
  require(is_unit(normal), "reflect: normal is a unit vector");
  const double factor = 2 * direction.dot(normal) / normal.squaredNorm();
  return (direction - factor * normal) / direction.norm();
}

}  // namespace etendue
