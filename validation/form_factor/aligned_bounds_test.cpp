// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "etendue/form_factor/aligned_pairs.hpp"
#include "etendue/form_factor/difference_rule.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

/// Half edges along the direction in question, its nearest and the line's nearest distance, the integrand's greatest value.
struct Direction {
  double first, second, near_u, off_line, greatest;
};

/// What n nodes may leave, by the nearest points: NOTES.md §8 of form_factor, written out.
double remainder(const Direction& d, int n, bool product, double area) {
  const double k = 2 * n, g = std::hypot(d.near_u, d.off_line), cone = std::pow(g / d.off_line, 3);
  const double coefficient = std::min((k + 1) * (k + 2) * (k + 3) / 6, (k + 2) / 2 * cone);
  const double powers = product ? 2 * legendre_remainder(n) * (std::pow(d.first / g, k) + std::pow(d.second / g, k))
                                : difference_remainder(n) * std::pow(d.first / g, k);
  return area / (4 * std::numbers::pi) * d.greatest * coefficient * powers;
}

/// The mean of s t/(u² + s² + t²)² over a rectangle, by the fundamental theorem: the primitive is ln(u² + s² + t²)/4.
double mean_kernel(double u, double s_1, double s_2, double t_1, double t_2) {
  const auto at = [u](double s, double t) { return std::log(u * u + s * s + t * t) / 4; };
  return (at(s_1, t_2) + at(s_2, t_1) - at(s_1, t_1) - at(s_2, t_2)) / ((s_2 - s_1) * (t_2 - t_1));
}

AlignedPlan planned(const Polygon& from, const Polygon& to, double relative) {
  AlignedPlan plan;
  plan.from.set(0, parallelogram(from, 0));
  plan.to.set(0, parallelogram(to, 1));
  plan.relative = relative;
  plan.make(false);
  return plan;
}

// CLAIM      IU.6-3: the bound of an aligned pair is no less than what the derivation asks for at the nearest points, not at
//            the centres: of patches beside one another along a common line these have quite other angles.
// ORACLE     identity: the remainders of NOTES.md §8 written out, the integrand's mean by its primitive.
// TOLERANCE  2^-20 of the remainder, for the roundings of the primitive's logarithms.
TEST(AlignedBounds, FollowFromTheNearestPoints) {
  constexpr std::uint64_t kSeed = 20261129;
  proves({"IU.6-3"}, Oracle::identity, "remainders at the nearest points, 3000 pairs");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::uint64_t below = 0, judged = 0, steeper = 0;
  const std::uint64_t pairs = long_run(3000);
  for (std::uint64_t k = 0; k < pairs; ++k) {
    share_done(k, pairs);
    const bool opposite = k % 2 == 0, equal = k % 3 != 0;
    const double a = random.scale(0.05, 1), b = random.scale(0.05, 2);
    const double c = equal || opposite ? a : random.scale(0.05, 1);
    const double aside = a * random.scale(0.5, 20), gap = random.scale(0.02, 2), up = random.scale(0.02, 2);
    const double asked = random.scale(1e-12, 1e-2);
    const Polygon from = rectangle({0, 0, 0}, {a, 0, 0}, {0, b, 0});
    const double x = a + aside;
    if (opposite) {
      const double y = random.between(-1, 1) * 2 * b;
      const AlignedPlan plan = planned(from, rectangle({x, y, gap}, {0, b, 0}, {a, 0, 0}), asked);
      if (plan.key[0] == AlignedPlan::kNone) continue;
      const double near_v = std::max(0.0, std::abs(y) - b);
      const double g = std::hypot(aside, std::hypot(gap, near_v)), greatest = gap * gap / (g * g * g * g);
      const int along_u = 2 + static_cast<int>(plan.key[0] % 32), along_v = 2 + static_cast<int>(plan.key[0] / 32 % 32);
      const Direction u{a / 2, a / 2, aside, std::hypot(gap, near_v), greatest};
      const Direction v{b / 2, b / 2, near_v, std::hypot(gap, aside), greatest};
      const double needed = remainder(u, along_u, false, a * b) + remainder(v, along_v, false, a * b);
      below += !(plan.bound[0] >= needed * (1 - 0x1p-20));
      steeper += g > 1.5 * u.off_line ? 1u : 0u;
      ++judged;
      continue;
    }
    const double y = b + gap, d = random.scale(0.05, 2);
    const AlignedPlan plan = planned(from, rectangle({x, y, up}, {c, 0, 0}, {0, 0, d}), asked);
    if (plan.key[0] == AlignedPlan::kNone) continue;
    const int nodes = 2 + static_cast<int>(plan.key[0] % 32);
    const Direction u{a / 2, c / 2, aside, std::hypot(gap, up), mean_kernel(aside, gap, y, up, up + d)};
    below += !(plan.bound[0] >= remainder(u, nodes, plan.key[0] < 256, c * d) * (1 - 0x1p-20));
    steeper += std::hypot(u.near_u, u.off_line) > 1.5 * u.off_line ? 1u : 0u;
    ++judged;
  }
  EXPECT_TRUE(all_agree(below, judged));
  EXPECT_GT(judged, pairs / 2);
  EXPECT_GT(steeper, judged / 4) << "where distance and distance off the line are alike, centres would do";
}

// CLAIM      IU.6-3: the sums over aligned pairs are the factors, within the plan's bound: by themselves, where factor rows would
//            go on to another method if a sum came out wrong.
// ORACLE     form_factor() of boundaries at 1e-12, which knows no rule for aligned pairs.
// TOLERANCE  the plan's bound and that of the truth.
TEST(AlignedBounds, HoldTheSumsThemselves) {
  constexpr std::uint64_t kSeed = 20261130;
  proves({"IU.6-3"}, Oracle::program, "form_factor() of boundaries at 1e-12, 400 pairs");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::uint64_t wrong = 0, judged = 0, perpendicular = 0;
  for (int k = 0; k < 400; ++k) {
    const double a = random.scale(0.2, 1), b = random.scale(0.2, 1), c = k % 3 == 0 ? random.scale(0.2, 1) : a;
    const double x = random.between(-2, 2), away = random.scale(0.3, 4), up = random.scale(0.05, 2);
    const Polygon from = rectangle({0, 0, 0}, {a, 0, 0}, {0, b, 0});
    const bool opposite = k % 2 == 0;
    const Polygon to = opposite ? rectangle({x, away, up + 0.3}, {0, b, 0}, {a, 0, 0})
                                : rectangle({x, b + away, up}, {c, 0, 0}, {0, 0, b});
    AlignedPlan plan = planned(from, to, random.scale(1e-10, 1e-3));
    if (plan.key[0] == AlignedPlan::kNone) continue;
    sum_aligned(plan.lanes, plan.key[0], k % 5 == 0);
    const Bounded truth = form_factor(Boundary{from.vertices()}, Boundary{to.vertices()}, {1e-12, 0});
    wrong += std::abs(plan.lanes.total[0] - truth.value) <= plan.bound[0] + truth.bound ? 0u : 1u;
    perpendicular += opposite ? 0u : 1u;
    ++judged;
  }
  EXPECT_TRUE(all_agree(wrong, judged));
  EXPECT_GT(perpendicular, 100u);
  EXPECT_GT(judged - perpendicular, 100u);
}

}  // namespace
}  // namespace etendue::validation
