// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/fresnel.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/optics/radicand.hpp"

namespace etendue {

double fresnel_reflectance(double cosine, double eta) {
  require(0 <= cosine && cosine <= 1, "fresnel_reflectance: cosine is in [0, 1]");
  require(kLeastIndexRatio <= eta && eta <= kGreatestIndexRatio,
          "fresnel_reflectance: eta is a ratio of refractive indices");
  if (eta == 1) return 0;
  if (cosine == 0) return 1;
  const DoubleDouble radicand = refraction_radicand(exact_product(cosine, cosine), {1, 0}, eta);
  if (radicand.high <= 0) return 1;

  // With c, c' the two cosines: sin(φ−θ)/sin(φ+θ) = (η² − 1)/(ηc + c')², and cos(φ+θ)/cos(φ−θ) leads from it to the
  // tangents' quotient. Neither subtracts what is nearly equal, nor divides zero by zero at θ = 0.
  const double behind = std::sqrt(radicand.high);
  const double sum = eta * cosine + behind;
  const double perpendicular = (eta - 1) * (eta + 1) / (sum * sum);
  const double cosines = cosine * behind;
  const double sines = eta * ((1 - cosine) * (1 + cosine));
  const double ratio = (cosines - sines) / (cosines + sines);
  const double reflectance = 0.5 * (perpendicular * perpendicular) * (1 + ratio * ratio);
  return std::min(reflectance, 1.0);  // absorbs the roundings above next to grazing incidence, fresnel_relative_error
}

}  // namespace etendue
