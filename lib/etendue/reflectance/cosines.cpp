// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/cosines.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/optics/unit.hpp"
#include "etendue/reflectance/ambient.hpp"

namespace etendue {

LightCosines light_cosines(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer) {
  require(is_unit(normal) && is_unit(to_light) && is_unit(to_viewer), "light_cosines: all vectors are unit vectors");
  const double incidence = normal.dot(to_light);
  return {incidence, 2 * incidence * normal.dot(to_viewer) - to_light.dot(to_viewer)};
}

LightCosines all_light_cosines(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer) {
  LightCosines cosines = light_cosines(normal, to_light, to_viewer);
  cosines.view = normal.dot(to_viewer);
  const Vec3 sum = to_light + to_viewer;
  const double length = sum.norm();
  if (!(length > 0)) return cosines;
  cosines.halfway = normal.dot(sum) / length;
  cosines.tilt = to_viewer.dot(sum) / length;
  return cosines;
}

Eigen::Array3d reflection_of_cosines(const LocalReflection& surface, const Eigen::Array3d& ambient_light,
                                     std::span<const LightCosines> cosines,
                                     std::span<const Eigen::Array3d> intensities) {
  require(cosines.size() == intensities.size(), "reflection_of_cosines: an intensity for each light");
  require(std::isfinite(surface.exponent) && surface.exponent >= 1,
          "reflection_of_cosines: exponent is finite and at least one");
  Eigen::Array3d sum = ambient(surface.k_a, ambient_light);
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    if (!(cosines[i].incidence > 0)) continue;
    const Eigen::Array3d arriving = cosines[i].share * intensities[i];
    const double lambert = std::min(cosines[i].incidence, 1.0);
    if (surface.highlight && surface.k_s != 0) {
      sum += arriving * (surface.k_d * lambert + surface.k_s * directed_reflection(*surface.highlight, cosines[i]));
      continue;
    }
    const double mirror = std::clamp(cosines[i].mirror, 0.0, 1.0);
    const double directed = surface.k_s == 0 || mirror == 0 ? 0 : surface.k_s * std::pow(mirror, surface.exponent);
    sum += arriving * (surface.k_d * lambert + directed);
  }
  return sum;
}

}  // namespace etendue
