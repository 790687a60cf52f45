// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/lambert.hpp"

#include <algorithm>

#include "etendue/core/contract.hpp"
#include "etendue/optics/unit.hpp"

namespace etendue {

double lambert(const Vec3& normal, const Vec3& to_light) {
  require(is_unit(normal), "lambert: normal is a unit vector");
  require(is_unit(to_light), "lambert: to_light is a unit vector");
  return std::max(0.0, normal.dot(to_light));
}

}  // namespace etendue
