// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/bump.hpp"

#include "etendue/core/contract.hpp"
#include "etendue/optics/reflect.hpp"
#include "etendue/optics/unit.hpp"

namespace etendue {

Vec3 height_gradient(const Vec3& along_u, const Vec3& along_v, const Relief& relief) {
  const Vec3 across = along_u.cross(along_v);
  const double area = across.squaredNorm();
  if (!(area > 0)) return Vec3::Zero();
  return (relief.along_u * along_v.cross(across) + relief.along_v * across.cross(along_u)) / area;
}

Vec3 bumped_normal(const Vec3& normal, const Vec3& gradient) {
  require(is_unit(normal), "bumped_normal: the normal is a unit vector");
  require(gradient.allFinite(), "bumped_normal: the gradient is finite");
  return (normal - (gradient - normal.dot(gradient) * normal)).stableNormalized();
}

Vec3 kept_outside(const Vec3& direction, const Vec3& normal) {
  return direction.dot(normal) > 0 ? direction : reflect(direction, normal);
}

}  // namespace etendue
