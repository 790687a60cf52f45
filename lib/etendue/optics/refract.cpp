// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/refract.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/optics/accurate_products.hpp"
#include "etendue/optics/radicand.hpp"
#include "etendue/optics/unit.hpp"

namespace etendue {

namespace {

// What the formula needs to know about the two vectors, to twice the precision of a double.
struct Incidence {
  DoubleDouble direction_squared;
  DoubleDouble normal_squared;
  DoubleDouble dot;
};

Incidence incidence(const Vec3& direction, const Vec3& normal) {
  return {dot_twice(direction, direction), dot_twice(normal, normal), dot_twice(direction, normal)};
}

std::optional<double> cosine_behind(const Incidence& at, double eta) {
  const DoubleDouble lengths = at.direction_squared * at.normal_squared;
  const DoubleDouble radicand = refraction_radicand(at.dot * at.dot, lengths, eta);
  if (radicand.high < 0) return std::nullopt;
  return std::sqrt(radicand.high / lengths.high);
}

void require_domain(const Vec3& direction, const Vec3& normal, double eta) {
  require(is_unit(direction), "refract: direction is a unit vector");
  require(is_unit(normal), "refract: normal is a unit vector");
  require(kLeastIndexRatio <= eta && eta <= kGreatestIndexRatio, "refract: eta is a ratio of refractive indices");
}

}  // namespace

std::optional<double> refracted_cosine(const Vec3& direction, const Vec3& normal, double eta) {
  require_domain(direction, normal, eta);
  return cosine_behind(incidence(direction, normal), eta);
}

std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal, double eta) {
  require_domain(direction, normal, eta);
  const Incidence at = incidence(direction, normal);
  const std::optional<double> cosine = cosine_behind(at, eta);
  if (!cosine) return std::nullopt;

  // s × (δ × s) = |s|² (δ − (δ·s) s / |s|²) is the sine vector of 5-4 without its cancellation near normal incidence.
  const Vec3 sine = cross_accurately(normal, cross_accurately(direction, normal));
  const double sine_scale = eta / (std::sqrt(at.direction_squared.high) * at.normal_squared.high);
  const double cosine_scale = *cosine / std::sqrt(at.normal_squared.high);
  const bool along_normal = at.dot.high > 0;
  return sine_scale * sine + (along_normal ? cosine_scale : -cosine_scale) * normal;
}

}  // namespace etendue
