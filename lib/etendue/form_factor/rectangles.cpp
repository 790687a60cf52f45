// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/rectangles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

using std::numbers::pi;

bool is_length(double x) {
  return x >= kShortestLength && x <= kLongestLength;
}

bool is_ratio(double x) {
  return x >= kLeastRatio && x <= kGreatestRatio;
}

/// F = (2/πY) ∫_0^Y (Y − v) atan(X/q)/q³ dv, q² = 1 + v²: every factor is positive. Its singularities v = ±i lie
/// outside the Bernstein ellipse 3 for Y ≤ 1, so kNodes leave 3^(−2 kNodes) of less than 10⁶ (NOTES.md §6).
Bounded by_integral(double x, double y) {
  constexpr int kNodes = 30;
  constexpr int kRoundings = kNodes + 24;
  double sum = 0;
  for (const QuadratureNode& node : gauss_legendre(kNodes)) {
    const double share = 0.5 * (1 + node.x);
    const double v = y * share;
    const double square = 1 + v * v;
    const double q = std::sqrt(square);
    sum += node.weight * (1 - share) * std::atan(x / q) / (square * q);
  }
  const double value = y / pi * sum;
  return {value, gamma_bound(kRoundings) * value};
}

Bounded by_formula(double x, double y) {
  constexpr int kRoundings = 16;
  const double x2 = x * x, y2 = y * y, sx = std::sqrt(1 + x2), sy = std::sqrt(1 + y2);
  const double logarithm = 0.5 * std::log1p(x2 * y2 / (1 + x2 + y2));
  const double across = x * sy * std::atan(x / sy) + y * sx * std::atan(y / sx);
  const double along = x * std::atan(x) + y * std::atan(y);
  const double scale = 2 / (pi * x * y);
  return {scale * (logarithm + across - along), gamma_bound(kRoundings) * scale * (logarithm + across + along)};
}

}  // namespace

Bounded parallel_rectangles(double width, double height, double distance) {
  require(is_length(width) && is_length(height) && is_length(distance),
          "parallel_rectangles: width, height and distance are within the lengths of the domain");
  const double x = std::max(width, height) / distance, y = std::min(width, height) / distance;
  require(is_ratio(x) && is_ratio(y), "parallel_rectangles: the ratios are within the domain");
  return y <= 1 ? by_integral(x, y) : by_formula(x, y);
}

Bounded perpendicular_rectangles(double width, double height, double common) {
  require(is_length(width) && is_length(height) && is_length(common),
          "perpendicular_rectangles: width, height and common edge are within the lengths of the domain");
  // A_1 F is symmetric in the two: s is the shorter, l the longer, r the hypotenuse.
  const double s = std::min(width, height) / common, l = std::max(width, height) / common;
  require(is_ratio(s) && is_ratio(l), "perpendicular_rectangles: the ratios are within the domain");
  const double s2 = s * s, l2 = l * l, r = std::hypot(s, l), r2 = s2 + l2;
  const double beyond = s2 / (r + l);  // r − l
  const double gain[] = {0.5 * std::log1p(s2), 2 * s * std::atan(1 / s), 2 * l * std::atan(beyond / (r * l + 1)),
                         0.5 * s2 * std::log1p(1 / r2)};
  const double loss[] = {0.5 * s2 * std::log1p(1 / s2), 0.5 * std::log1p(s2 / (1 + l2)), 2 * beyond * std::atan(1 / r),
                         0.5 * l2 * std::log1p(s2 / ((1 + r2) * l2))};
  double plus = 0, minus = 0;
  for (int i = 0; i < 4; ++i) {
    plus += gain[i];
    minus += loss[i];
  }
  constexpr int kRoundings = 16;
  const double scale = common / (2 * pi * width);
  return {scale * (plus - minus), gamma_bound(kRoundings) * scale * (plus + minus)};
}

}  // namespace etendue
