// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/polygon_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/area_rule.hpp"
#include "etendue/form_factor/contour.hpp"
#include "etendue/form_factor/facing_pair.hpp"
#include "etendue/form_factor/factor_rows.hpp"

namespace etendue {

namespace {

/// A first idea of 2π A_1 F, good to a small factor: sets the goal of the quadrature, never a bound.
double rough_size(const FacingRegions& pair) {
  const Loop &from = pair.from_loops.front(), &to = pair.to_loops.front();
  const Vec3& offset = pair.offset;
  Vec3 centre_1 = Vec3::Zero(), centre_2 = Vec3::Zero();
  for (const Vec3& v : from.vertices) centre_1 += v / static_cast<double>(from.vertices.size());
  for (const Vec3& v : to.vertices) centre_2 += v / static_cast<double>(to.vertices.size());
  const Vec3 r = offset + (centre_2 - centre_1);
  const double square = r.squaredNorm();
  const double cosines = std::abs(r.dot(from.normal)) * std::abs(r.dot(to.normal)) / square;
  const double kernel = cosines * from.area * to.area / square;
  return 2 * std::min(kernel, std::numbers::pi * std::min(from.area, to.area));
}

/// Kernel evaluations up to which the area rule is cheaper than the contour in double, and in twice the digits.
constexpr double kCheapArea = 1500;
constexpr double kCostlyArea = 20000;
/// Less than this cannot be asked: the last roundings alone are more.
constexpr double kLeastAsked = 0x1p-50;

/// What is asked of 2π A_1 F.
struct Goal {
  double relative;
  double absolute;

  double at(double size) const { return std::max(absolute, relative * std::abs(size)); }
};

bool reaches(const QuadratureSum& sum, const Goal& asked) {
  return sum.truncation + sum.rounding <= asked.at(sum.value);
}

/// 2π A_1 F by the cheapest method in double.
QuadratureSum in_double(const FacingRegions& pair, double goal, const Goal& asked) {
  const auto area = double_area(pair.from_loops, pair.to_loops, pair.offset, goal, kCheapArea);
  if (area && area->rounding <= asked.at(area->value)) return *area;
  return double_contour(pair.from, pair.to, goal, Digits::single);
}

/// 2π A_1 F. The goal follows from the value: it is guessed first, and the arithmetic widened where rounding stands in
/// the way.
QuadratureSum integrate(const FacingRegions& pair, const Goal& asked) {
  double size = 0.25 * rough_size(pair), goal = 0.5 * asked.at(size);
  QuadratureSum sum = in_double(pair, goal, asked);
  if (reaches(sum, asked)) return sum;
  const auto tighten = [&] {
    const double wanted = 0.5 * asked.at(std::max(std::abs(sum.value) - sum.truncation - sum.rounding, 0x1p-10 * size));
    const bool tighter = wanted < 0.9 * goal;
    size = std::min(size, std::abs(sum.value));
    goal = std::min(goal, wanted);
    return tighter;
  };
  if (tighten() && sum.rounding <= goal) {
    sum = in_double(pair, goal, asked);
    if (reaches(sum, asked)) return sum;
    tighten();
  }
  const auto area = double_area(pair.from_loops, pair.to_loops, pair.offset, goal, kCostlyArea);
  if (area && reaches(*area, asked)) return *area;
  constexpr int kAttempts = 3;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    sum = double_contour(pair.from, pair.to, goal, Digits::twice);
    if (reaches(sum, asked) || !tighten()) break;
  }
  return area && area->truncation + area->rounding < sum.truncation + sum.rounding ? *area : sum;
}

constexpr int kFinalRoundings = 16;  // the area, its product with 2π, the division

/// What roundings of twice the digits cost a factor, or more: not worth another cut.
constexpr double kLeastOwed = 0x1p-80;

/// What is in front of one another, integrated.
Bounded factor_of(const FacingRegions& pair, Tolerance tolerance) {
  // A_1 is square to the scale, which cancels in the factor.
  const double to_factor = 1 / (2 * std::numbers::pi * pair.from_area);
  if (!pair.sees()) return {0, std::min(1.0, pair.moved / pair.from_area * (1 + gamma_bound(kFinalRoundings)))};
  const Goal asked{std::max(tolerance.relative, kLeastAsked), tolerance.absolute / to_factor};
  const QuadratureSum sum = integrate(pair, asked);
  constexpr double kMovedShare = 2 * std::numbers::pi;  // the sum is 2π A_1 F_12
  Bounded result;
  result.value = sum.value * to_factor;
  result.bound = (sum.truncation + sum.rounding + kMovedShare * (pair.moved + pair.behind)) * to_factor +
                 gamma_bound(kFinalRoundings) * std::abs(result.value);
  // 0 ≤ F ≤ 1 holds for the truth: moving the value into the range by at most its error only brings it nearer.
  result.value = std::clamp(result.value, 0.0, 1.0);
  result.bound = std::min(result.bound, 1.0);
  return result;
}

}  // namespace

Bounded form_factor(const Boundary& from, const Boundary& to, Tolerance tolerance) {
  require(tolerance.relative >= 0 && tolerance.absolute >= 0, "form_factor: tolerances are not negative");
  const FacingRegions pair = facing_regions(from, to);
  const Bounded result = factor_of(pair, tolerance);
  const double owed = (pair.moved + pair.behind) / pair.from_area;
  if (!pair.flat || owed <= kLeastOwed) return result;
  if (result.bound <= std::max(tolerance.absolute, tolerance.relative * result.value)) return result;
  // Hairs on the wrong side of the other's plane were left as they are: cut off, they cost corners, but no bound.
  const Bounded cut = factor_of(facing_regions(from, to, Sides::exact), tolerance);
  return cut.bound < result.bound ? cut : result;
}

Bounded form_factor(const Polygon& from, const Polygon& to, Tolerance tolerance) {
  require(tolerance.relative >= 0 && tolerance.absolute >= 0, "form_factor: tolerances are not negative");
  if (const auto factor = product_factor(from, to, tolerance)) return *factor;
  return form_factor(Boundary{from.vertices()}, Boundary{to.vertices()}, tolerance);
}

}  // namespace etendue
