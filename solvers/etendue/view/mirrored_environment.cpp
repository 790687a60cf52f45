// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/mirrored_environment.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/optics/fresnel.hpp"
#include "etendue/optics/reflect.hpp"
#include "etendue/reflectance/bump.hpp"

namespace etendue {

Rgb mirrored_environment(const Material& material, const Vec3& direction, const Vec3& smooth, const Vec3& shaded) {
  require(material.environment != nullptr, "mirrored_environment: the material has an environment");
  const double cosine = std::min(std::abs(direction.dot(shaded)), 1.0);  // absorbs the rounding of unit vectors
  const double share =
      material.fresnel ? (material.k_r + material.k_t) * fresnel_reflectance(cosine, 1 / material.eta) : material.k_r;
  return share * material.environment->at(kept_outside(reflect(direction, shaded), smooth));
}

}  // namespace etendue
