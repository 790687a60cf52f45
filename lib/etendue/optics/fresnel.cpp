// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/fresnel.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/double_double.hpp"
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

double fresnel_conductor(double cosine, double eta, double k) {
  require(0 <= cosine && cosine <= 1, "fresnel_conductor: cosine is in [0, 1]");
  require(kLeastIndexRatio <= eta && eta <= kGreatestIndexRatio,
          "fresnel_conductor: eta is a ratio of refractive indices");
  require(0 <= k && k <= kGreatestIndexRatio, "fresnel_conductor: k is not negative");
  if (eta == 1 && k == 0) return 0;  // no boundary; c² below would underflow
  const double c = cosine, sines = (1 - c) * (1 + c);
  // The root of real + 2iηk in the first quadrant: its larger part by a sum, the other one by the product ab = ηk.
  const DoubleDouble squares = exact_product(eta, eta) - exact_product(k, k) + exact_product(c, c) - DoubleDouble(1);
  const double real = squares.high, modulus = std::hypot(real, 2 * eta * k);
  const double larger = std::sqrt(0.5 * (modulus + std::abs(real)));
  const double smaller = larger > 0 ? eta * k / larger : 0;
  const double a = real >= 0 ? larger : smaller, b = real >= 0 ? smaller : larger;
  const auto quotient = [](double difference, double sum, double rest) {
    const double below = sum * sum + rest * rest;
    return below > 0 ? (difference * difference + rest * rest) / below : 1;  // 0/0 at grazing incidence alone
  };
  const double perpendicular = quotient(a - c, a + c, b);
  const double parallel = perpendicular * quotient(a * c - sines, a * c + sines, b * c);
  return std::min(0.5 * (perpendicular + parallel), 1.0);
}

double schlick(double cosine, double normal) {
  require(0 <= cosine && cosine <= 1, "schlick: cosine is in [0, 1]");
  require(0 <= normal && normal <= 1, "schlick: the reflectance at normal incidence is in [0, 1]");
  const double rest = 1 - cosine, squared = rest * rest;
  return normal + (1 - normal) * squared * squared * rest;
}

}  // namespace etendue
