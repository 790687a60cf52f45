// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/area_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

int parts(const Light& light) {
  if (const auto* rectangle = std::get_if<RectangleLight>(&light)) return rectangle->samples;
  if (const auto* sphere = std::get_if<SphereLight>(&light)) return sphere->samples;
  return 1;
}

}  // namespace

int shadow_rays(const Light& light) {
  return parts(light) * parts(light);
}

PointLight light_part(const Light& light, int index, const SampleKey& key) {
  const int n = parts(light);
  require(index >= 0 && index < n * n, "light_part: the part exists");
  const auto number = static_cast<std::uint64_t>(index);
  const double a = (index % n + key.number(2 * number)) / n;
  const double b = (index / n + key.number(2 * number + 1)) / n;
  if (const auto* rectangle = std::get_if<RectangleLight>(&light)) {
    return {rectangle->corner + a * rectangle->u + b * rectangle->v, rectangle->intensity / (n * n)};
  }
  const auto* sphere = std::get_if<SphereLight>(&light);
  require(sphere != nullptr, "light_part: the light has an area");
  const double z = 1 - 2 * a, turn = 2 * std::numbers::pi * b;
  const double out = std::sqrt(std::max(0.0, 1 - z * z));  // rounding below zero is on the axis
  return {sphere->centre + sphere->radius * Vec3(out * std::cos(turn), out * std::sin(turn), z),
          sphere->intensity / (n * n)};
}

}  // namespace etendue
