// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/frost.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"

namespace etendue {

Vec3 frosted(const Vec3& clear, const Vec3& normal, double frost, double a, double b) {
  require(frost >= 0 && frost <= kMostFrost, "frosted: the frost is in [0, 1/2]");
  if (frost == 0) return clear;
  const double cosine = std::pow(a, frost / (1 - frost));
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));  // pow rounds to at most 1
  const double turn = 2 * std::numbers::pi * b;
  const Vec3 across = clear.unitOrthogonal(), along = clear.cross(across);
  const Vec3 direction = cosine * clear + sine * (std::cos(turn) * across + std::sin(turn) * along);
  const double out = direction.dot(normal);
  return (out * clear.dot(normal) < 0 ? Vec3(direction - 2 * out * normal) : direction).normalized();
}

}  // namespace etendue
