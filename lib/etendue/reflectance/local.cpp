// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/local.hpp"

#include "etendue/reflectance/ambient.hpp"
#include "etendue/reflectance/cosines.hpp"
#include "etendue/reflectance/lambert.hpp"
#include "etendue/reflectance/phong.hpp"

namespace etendue {

Eigen::Array3d local_reflection(const LocalReflection& surface, const Vec3& normal, const Vec3& to_viewer,
                                const Eigen::Array3d& ambient_light, std::span<const IncidentLight> lights) {
  Eigen::Array3d sum = ambient(surface.k_a, ambient_light);
  for (const IncidentLight& light : lights) {
    const Eigen::Array3d diffuse = surface.k_d * lambert(normal, light.to_light);
    Eigen::Array3d directed = Eigen::Array3d::Zero();
    if (surface.k_s != 0 && surface.highlight) {
      directed =
          surface.k_s * directed_reflection(*surface.highlight, all_light_cosines(normal, light.to_light, to_viewer));
    } else if (surface.k_s != 0) {
      directed = Eigen::Array3d::Constant(surface.k_s * phong(normal, light.to_light, to_viewer, surface.exponent));
    }
    sum += light.attenuation * light.intensity * (diffuse + directed);
  }
  return sum;
}

}  // namespace etendue
