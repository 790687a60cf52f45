// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/attenuation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"

namespace etendue {

double linear_attenuation(double distance, double d0) {
  require(std::isfinite(distance) && distance >= 0, "linear_attenuation: distance is finite and not negative");
  require(std::isfinite(d0) && d0 >= 0, "linear_attenuation: d0 is finite and not negative");
  return 1 / std::max(1.0, distance + d0);
}

double irradiance_of_power(double power, double distance) {
  return irradiance_of_intensity(power / (4 * std::numbers::pi), distance);
}

double irradiance_of_intensity(double intensity, double distance) {
  require(std::isfinite(intensity) && intensity >= 0, "irradiance: the source is finite and not negative");
  require(distance > 0, "irradiance: distance is positive");
  require(std::isnormal(distance * distance), "irradiance: the distance's square is a normal number");
  return intensity / (distance * distance);
}

double arriving_share(const Falloff& falloff, double distance) {
  if (falloff.law == Falloff::Law::none) return 1;
  const double d = distance / falloff.unit;
  if (falloff.law == Falloff::Law::linear) return linear_attenuation(d, falloff.d0);
  return std::isnormal(d * d) ? irradiance_of_intensity(1, d) : 0;
}

}  // namespace etendue
