// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/product_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "etendue/form_factor/taylor_coefficients.hpp"

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLeastNodes = ProductPlan::kLeastNodes, kMostNodes = ProductPlan::kMostNodes;
/// Kernel evaluations beyond which form_factor() is the cheaper one.
constexpr double kMostKernels = 6561;

constexpr std::size_t kRules = kMostNodes - kLeastNodes + 1;
using ByRule = std::array<double, kRules>;

/// The rules' remainders, and the factors in the bounds of the Taylor coefficient of r^(−4) (NOTES.md §8).
struct RuleErrors {
  ByRule remainder{};
  ByRule steep_even{}, steep_odd{};  ///< for k = 2n and 2n − 1
  ByRule flat_even{}, flat_odd{};
};

RuleErrors compute_rule_errors() {
  RuleErrors errors;
  for (int n = kLeastNodes; n <= kMostNodes; ++n) {
    const auto i = static_cast<std::size_t>(n - kLeastNodes);
    errors.remainder[i] = legendre_remainder(n);
    errors.steep_even[i] = steep_coefficient(2 * n);
    errors.steep_odd[i] = steep_coefficient(2 * n - 1);
    errors.flat_even[i] = flat_coefficient(2 * n);
    errors.flat_odd[i] = flat_coefficient(2 * n - 1);
  }
  return errors;
}

/// One direction: the lengths and heights that its error follows from.
struct Direction {
  double weight, q, fourth, flat, top, slope;
};

/// The first rule whose error is at most `share`; kRules where there is none.
struct Choice {
  std::size_t rule;
  double error;
};

Choice choose(const Direction& d, const RuleErrors& rules, double share) {
  const double square = d.q * d.q, top = d.top * d.q;
  double power = d.weight * d.q * square;
  for (std::size_t i = 0; i < kRules; ++i) {
    const double even = std::min(rules.steep_even[i] * d.fourth, rules.flat_even[i] * d.flat);
    const double odd = std::min(rules.steep_odd[i] * d.fourth, rules.flat_odd[i] * d.flat);
    const double error = power * rules.remainder[i] * (top * even + d.slope * odd);
    if (error <= share) return {i, error};
    power *= square;
  }
  return {kRules, 0};
}

}  // namespace

ProductPlan product_plan(const Parallelogram& from, const Parallelogram& to, const Tolerance& tolerance) {
  ProductPlan result;
  if (from.plane == to.plane) {
    result.kind = ProductPlan::Kind::nothing;
    return result;
  }
  if (!from.valid || !to.valid) return result;
  const Vec3 between = (to.corner - from.corner) + (to.centre - from.centre);
  const double square = between.squaredNorm(), distance = std::sqrt(square), radii = from.radius + to.radius;
  constexpr double kSmallest = 0x1p-150, kLargest = 0x1p150;  // fourth powers of distances, squares of areas
  if (!(distance > kSmallest && distance < kLargest)) return result;
  const double reach = distance + radii, nearest = distance - radii;
  constexpr double kHeightRoundings = 16;
  const double slack = kHeightRoundings * kUnitRoundoff * reach + from.flatness + to.flatness;
  const double rise[2] = {from.normal.dot(to.half[0]), from.normal.dot(to.half[1])};
  const double fall[2] = {to.normal.dot(from.half[0]), to.normal.dot(from.half[1])};
  const double height = from.normal.dot(between), depth = -to.normal.dot(between);
  const double height_range = std::abs(rise[0]) + std::abs(rise[1]),
               depth_range = std::abs(fall[0]) + std::abs(fall[1]);
  const double highest = height + height_range, deepest = depth + depth_range;
  if (highest < -slack || deepest < -slack) {
    result.kind = ProductPlan::Kind::nothing;
    return result;
  }
  if (!(height - height_range >= -slack && depth - depth_range >= -slack && nearest > 0) || !(highest > 2 * slack) ||
      !(deepest > 2 * slack)) {
    return result;
  }
  const double scale = to.area / kPi, inverse = 1 / nearest, fourth = inverse * inverse * inverse * inverse;
  const double asked = std::max(tolerance.absolute, tolerance.relative * scale * height * depth / (square * square));
  // Rounding: heights err by the slack, r^4 by a few roundings of reach/nearest, the sum by its terms; NOTES.md §8.
  constexpr double kTerms = 2 * kMostNodes + 40, kFourthPower = 32;
  const double rounding =
      scale * fourth *
      (highest * deepest * (kUnitRoundoff * (kTerms + kFourthPower * reach * inverse) + from.shape + to.shape) +
       2 * slack * (highest + deepest));
  const double share = 0.25 * (0.75 * asked - rounding);
  if (!(share > 0)) return result;
  static const RuleErrors rules = compute_rule_errors();
  double kernels = 1;
  double truncation = 0;
  for (int direction = 0; direction < 4; ++direction) {
    const bool own = direction < 2;
    const Parallelogram& patch = own ? from : to;
    const int side = direction % 2;
    const double length = patch.length[side];
    // Off the line along this direction: no point of the pair is nearer to it than `off`.
    const double along = between.dot(patch.half[side]) / length;
    const double off = std::sqrt(std::max(0.0, (1 - 0x1p-48) * square - along * along)) - radii - slack;
    const double flat = off > 0 ? inverse / (off * off * off) : std::numeric_limits<double>::infinity();
    const double q = length * inverse, slope = std::abs(own ? fall[side] : rise[side]);
    const double top = own ? deepest : highest, other = (own ? highest : deepest) + slack;
    // scale/16 for the Jacobians and 8 for the other three rules
    const double weight = 0.5 * scale * other;
    const Choice chosen = choose({weight, q, fourth, flat, top + slack, slope}, rules, share);
    if (chosen.rule == kRules) return result;
    kernels *= static_cast<double>(chosen.rule) + kLeastNodes;
    result.key |= static_cast<std::uint32_t>(chosen.rule) << (3 * direction);
    truncation += chosen.error;
  }
  if (kernels > kMostKernels) return result;
  result.kind = ProductPlan::Kind::rule;
  constexpr double kOwn = 1 + 0x1p-40;  // the roundings of this bound itself
  result.bound = kOwn * (truncation + rounding);
  return result;
}

}  // namespace etendue
