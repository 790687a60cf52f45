// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/polygon_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/area_rule.hpp"
#include "etendue/form_factor/contour.hpp"
#include "etendue/form_factor/facing_pair.hpp"

namespace etendue {

namespace {

std::vector<Vec3> shifted(const std::vector<Vec3>& vertices, const Vec3& offset) {
  std::vector<Vec3> result;
  result.reserve(vertices.size());
  for (const Vec3& v : vertices) result.push_back(v + offset);
  return result;
}

/// A first idea of 2π A_1 F, good to a small factor: sets the goal of the quadrature, never a bound.
double rough_size(const Loop& from, const Loop& to, const Vec3& offset) {
  Vec3 centre_1 = Vec3::Zero(), centre_2 = Vec3::Zero();
  for (const Vec3& v : from.vertices) centre_1 += v / static_cast<double>(from.vertices.size());
  for (const Vec3& v : to.vertices) centre_2 += v / static_cast<double>(to.vertices.size());
  const Vec3 r = offset + (centre_2 - centre_1);
  const double square = r.squaredNorm();
  const double cosines = std::abs(r.dot(from.normal)) * std::abs(r.dot(to.normal)) / square;
  const double kernel = cosines * from.area * to.area / square;
  return 2 * std::min(kernel, std::numbers::pi * std::min(from.area, to.area));
}

/// How many nodes a direction the area rule may spend before the contour is cheaper.
constexpr int kCheapAreaNodes = 6;
constexpr int kMostAreaNodes = 10;

QuadratureSum integrate(const FacingPair& pair, double goal) {
  if (auto area = double_area(pair.from, pair.to, pair.offset, goal, kCheapAreaNodes)) return *area;
  const std::vector<Vec3> second = shifted(pair.to.vertices, pair.offset);
  QuadratureSum contour = double_contour(pair.from.vertices, second, goal);
  if (contour.truncation + contour.rounding <= 2 * goal) return contour;
  if (auto area = double_area(pair.from, pair.to, pair.offset, goal, kMostAreaNodes)) {
    if (area->truncation + area->rounding < contour.truncation + contour.rounding) return *area;
  }
  return contour;
}

}  // namespace

Bounded form_factor(const Polygon& from, const Polygon& to, Tolerance tolerance) {
  require(tolerance.relative >= 0 && tolerance.absolute >= 0, "form_factor: tolerances are not negative");
  const FacingPair pair = facing_pair(from, to);
  if (!pair.sees()) return {0, 0};
  const double to_factor = 1 / (2 * std::numbers::pi * pair.from_area);
  const double absolute_goal = tolerance.absolute / to_factor;
  double size = 0.25 * rough_size(pair.from, pair.to, pair.offset);
  QuadratureSum sum;
  constexpr int kAttempts = 3;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const double goal = 0.5 * std::max(absolute_goal, tolerance.relative * size);
    sum = integrate(pair, goal);
    const double reached = std::max(absolute_goal, tolerance.relative * std::abs(sum.value));
    if (sum.truncation <= 0.5 * reached || sum.truncation <= sum.rounding) break;
    size = std::min(std::abs(sum.value), 0.25 * size);
  }
  constexpr int kFinalRoundings = 8;  // the area, its product with 2π, the division
  Bounded result;
  result.value = sum.value * to_factor;
  result.bound =
      (sum.truncation + sum.rounding + pair.moved) * to_factor + gamma_bound(kFinalRoundings) * std::abs(result.value);
  // 0 ≤ F ≤ 1 holds for the truth: moving the value into the range by at most its error only brings it nearer.
  result.value = std::clamp(result.value, 0.0, 1.0);
  return result;
}

}  // namespace etendue
