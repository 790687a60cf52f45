// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/local.hpp"

#include "etendue/reflectance/ambient.hpp"
#include "etendue/reflectance/lambert.hpp"
#include "etendue/reflectance/phong.hpp"

namespace etendue {

Eigen::Array3d local_reflection(const LocalReflection& surface, const Vec3& normal, const Vec3& to_viewer,
                                const Eigen::Array3d& ambient_light, std::span<const IncidentLight> lights) {
  Eigen::Array3d sum = ambient(surface.k_a, ambient_light);
  for (const IncidentLight& light : lights) {
    const Eigen::Array3d diffuse = surface.k_d * lambert(normal, light.to_light);
    const double directed =
        surface.k_s == 0 ? 0 : surface.k_s * phong(normal, light.to_light, to_viewer, surface.exponent);
    sum += light.attenuation * light.intensity * (diffuse + directed);
  }
  return sum;
}

}  // namespace etendue
