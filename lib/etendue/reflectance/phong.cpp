// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/phong.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/optics/unit.hpp"

namespace etendue {

double phong(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer, double exponent) {
  require(is_unit(to_viewer), "phong: to_viewer is a unit vector");
  require(std::isfinite(exponent) && exponent >= 1, "phong: exponent is finite and at least one");
  const Vec3 mirrored = reflect(-to_light, normal);
  if (normal.dot(to_light) <= 0) return 0;
  const double cosine = std::clamp(mirrored.dot(to_viewer), 0.0, 1.0);  // above one by reflection_error() at most
  return std::pow(cosine, exponent);
}

double weighted_phong(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer, double exponent,
                      const std::function<double(double)>& weight) {
  const double lobe = phong(normal, to_light, to_viewer, exponent);
  return lobe == 0 ? 0 : weight(std::min(normal.dot(to_light), 1.0)) * lobe;
}

double blinn(const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer, double exponent) {
  require(is_unit(normal) && is_unit(to_light) && is_unit(to_viewer), "blinn: all vectors are unit vectors");
  require(std::isfinite(exponent) && exponent >= 1, "blinn: exponent is finite and at least one");
  if (normal.dot(to_light) <= 0 || normal.dot(to_viewer) <= 0) return 0;
  const Vec3 halfway = (to_light + to_viewer).normalized();  // not zero: both are on the normal's side
  return std::pow(std::clamp(normal.dot(halfway), 0.0, 1.0), exponent);
}

}  // namespace etendue
