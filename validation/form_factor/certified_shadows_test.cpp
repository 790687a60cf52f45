// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "etendue/form_factor/certified.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/parallel_plates.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20261124;
const Polygon kFloor = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
const Polygon kCeiling = rectangle({0, 0, 1}, {0, 1, 0}, {1, 0, 0});

double unit(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

CertifiedGoal to_relative(double relative, std::int64_t work = 200'000) {
  return {{relative, 0}, work};
}

// CLAIM      IU.6-4: past a half-plane midway between two plates the enclosure holds exactly half, and closes in on it;
//            in a tilted frame, where parallels are parallel but for rounding, it holds it and is wider.
// ORACLE     closed form: C-11 / 2 by the point reflection at the centre.
// TOLERANCE  none for the inclusion but the frame's rounding; the goal for the width, 1e-2 in the tilted frame.
TEST(CertifiedObstruction, ClosesInOnHalfPastAHalfPlane) {
  proves({"IU.6-4"}, Oracle::closed_form, "C-11 / 2 by symmetry, goals 1e-2 to 1e-7");
  const Polygon screen = rectangle({-5, -5, 0.5}, {5.5, 0, 0}, {0, 10, 0});
  const double truth = 0.5 * oracle::parallel_plates(1, 1);
  constexpr double kFrame = 64 * 0x1p-53;
  const auto check = [&](const CertifiedFactor& f, double asked) {
    EXPECT_TRUE(holds(f.factor.lower - kFrame <= truth && truth <= f.factor.upper + kFrame)) << asked;
    EXPECT_TRUE(within(0.5 * f.factor.width(), asked * f.factor.middle())) << asked;
    EXPECT_TRUE(holds(f.reached)) << asked;
  };
  const std::vector<Polygon> straight{screen}, turned{tilted(screen)};
  for (const double asked : {1e-2, 1e-4, 1e-5, 1e-6, 1e-7}) {
    check(certified_form_factor(kFloor, kCeiling, straight, to_relative(asked)), asked);
  }
  check(certified_form_factor(tilted(kFloor), tilted(kCeiling), turned, to_relative(1e-2)), 1e-2);
}

// CLAIM      IU.6-4: nothing is left past a blocker that hides all; one behind, in either plane, beside, or one of the two
//            polygons themselves takes nothing. In a tilted frame, too, where planes are planes but for rounding.
// ORACLE     identity: H = 0 and H = 1.
// TOLERANCE  kLeft for what rounding leaves open.
TEST(CertifiedObstruction, IsAllOrNothingWhereAllOrNothingIsHidden) {
  proves({"IU.6-4"}, Oracle::identity, "H = 0 and H = 1 everywhere");
  constexpr double kLeft = 1e-9;
  const std::vector<Polygon> all{rectangle({-1, -1, 0.4}, {3, 0, 0}, {0, 3, 0.1})};
  EXPECT_TRUE(within(certified_form_factor(kFloor, kCeiling, all).factor.upper, kLeft));
  const std::vector<Polygon> none{rectangle({1.5, 0, 0.4}, {1, 0, 0}, {0, 1, 0.1}),  // aside
                                  rectangle({0, 0, 1.5}, {1, 0, 0}, {0, 1, 0.1}),    // above
                                  rectangle({1, 0, 0}, {1, 0, 0}, {0, 1, 0}),        // beside the floor, in its plane
                                  rectangle({0, 1, 1}, {0, 1, 0}, {1, 0, 0}),        // beside the ceiling
                                  kFloor,
                                  kCeiling};
  const double free = oracle::parallel_plates(1, 1);
  std::vector<Polygon> moved;
  for (const Polygon& p : none) moved.push_back(tilted(p));
  for (const auto& f : {certified_form_factor(kFloor, kCeiling, none),
                        certified_form_factor(tilted(kFloor), tilted(kCeiling), moved)}) {
    EXPECT_TRUE(within(std::abs(f.factor.lower - free), kLeft));
    EXPECT_TRUE(within(std::abs(f.factor.upper - free), kLeft));
  }
}

// CLAIM      IU.6-4: a screen cut in two: the enclosures past either part add up to one that holds the free factor.
// ORACLE     identity: F past part one + F past part two = F free, since together they hide all.
// TOLERANCE  none; the free factor for the width that the work allows.
TEST(CertifiedObstruction, AddsUpOverTheTwoPartsOfAScreen) {
  proves({"IU.6-4"}, Oracle::identity, "complementary screens, 6 random cases");
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  std::uint64_t missed = 0, decisions = 0;
  for (int i = 0; i < 6; ++i) {
    const double d = 0.5 + unit(random), shift = unit(random), tilt = 0.4 * unit(random);
    const Polygon from = tilted(kFloor), to = tilted(rectangle({shift, 0.2, d}, {0, 1, 0}, {1, 0, tilt}));
    const double lean = 0.1 * (unit(random) - 0.5), height = d * (0.2 + 0.5 * unit(random));
    const double turn = std::numbers::pi * unit(random), x = 0.2 + 0.6 * unit(random), y = 0.3 + 0.4 * unit(random);
    const Vec3 middle(x + 0.4 * shift, y, height);
    const Vec3 along = 4 * Vec3(std::cos(turn), std::sin(turn), lean);
    const Vec3 across = 4 * Vec3(-std::sin(turn), std::cos(turn), 0);
    const std::vector<Polygon> one{tilted(rectangle(middle - along, 2 * along, across))};
    const std::vector<Polygon> two{tilted(rectangle(middle - along, 2 * along, -across))};
    const Interval sum = certified_form_factor(from, to, one, to_relative(1e-2, 60'000)).factor +
                         certified_form_factor(from, to, two, to_relative(1e-2, 60'000)).factor;
    const Interval free = certified_form_factor(from, to).factor;
    missed += !sum.contains(free);
    ++decisions;
    EXPECT_TRUE(within(sum.width(), free.upper));
  }
  EXPECT_TRUE(all_agree(missed, decisions));
}

/// One blocker between the plates: floating, standing on the floor, hanging, from floor to ceiling, touching an edge,
/// touching a corner.
Polygon random_blocker(std::mt19937_64& random, int family) {
  const double x = unit(random), y = unit(random), z = unit(random), turn = std::numbers::pi * unit(random);
  const Vec3 foot(0.1 + 0.5 * x, 0.1 + 0.5 * y, 0), along = 0.4 * Vec3(std::cos(turn), std::sin(turn), 0);
  switch (family) {
    case 0:
      return rectangle(foot + Vec3(0, 0, 0.2 + 0.6 * z), along, Vec3(-along.y(), along.x(), 0.3 * (z - 0.5)));
    case 1:
      return rectangle(foot, along, {0, 0, 0.2 + 0.6 * z});
    case 2:
      return rectangle(foot + Vec3(0, 0, 1), along, {0, 0, -0.2 - 0.6 * z});
    case 3:
      return rectangle(foot, along, {0, 0, 1});
    case 4:
      return rectangle({0, 0, 1}, {1, 0, 0}, {0, 0.1 + 0.5 * y, -0.1 - 0.5 * z});
    default:
      return polygon({{0, 0, 0}, {0.3 + 0.5 * x, 0.1, 0.2 + 0.5 * z}, {0.1, 0.3 + 0.5 * y, 0.3}});
  }
}

// CLAIM      IU.6-4: the factor past random blockers, in a frame of no axis, lies in its enclosure; the estimate of the
//            engine's error is never too small.
// ORACLE     program: the enclosure is the judge of obstructed_form_factor.
// TOLERANCE  the engine's bound; kWide of the factor for the width past one blocker, at the work allowed.
TEST(CertifiedObstruction, JudgesTheObstructedEngine) {
  proves({"IU.6-4"}, Oracle::program, "6 families of 4 random blockers; pairs of them");
  uses_seed(kSeed + 1);
  std::mt19937_64 random(kSeed + 1);
  constexpr int kFamilies = 6, kCases = 4;
  constexpr double kAsked = 1e-2, kWide = 0.3;
  std::uint64_t contradictions = 0, decisions = 0, wide = 0;
  for (int i = 0; i < kFamilies * kCases; ++i) {
    std::vector<Polygon> blockers{tilted(random_blocker(random, i % kFamilies))};
    if (i % kCases == kCases - 1) blockers.push_back(tilted(random_blocker(random, 0)));
    const auto certain = certified_form_factor(tilted(kFloor), tilted(kCeiling), blockers, to_relative(kAsked, 60'000));
    const Bounded engine = obstructed_form_factor(tilted(kFloor), tilted(kCeiling), blockers, {1e-5, 0});
    const bool well =
        engine.value + engine.bound >= certain.factor.lower && engine.value - engine.bound <= certain.factor.upper;
    EXPECT_TRUE(well) << i << ": " << engine.value << " in [" << certain.factor.lower << ", " << certain.factor.upper
                      << "]";
    contradictions += !well;
    wide += blockers.size() == 1 && certain.factor.width() > kWide * certain.factor.middle();
    ++decisions;
  }
  EXPECT_TRUE(all_agree(contradictions, decisions));
  EXPECT_TRUE(within(static_cast<double>(wide), 2)) << "blockers whose shadows were not told in the work allowed";
}

// CLAIM      IU.6-4: of two blockers whose shadows overlap, one of them hanging from the receiver, what both hide counts once.
// ORACLE     program: obstructed_form_factor at 1e-7.
// TOLERANCE  the engine's bound; kAsked for the width.
TEST(CertifiedObstruction, CountsCommonShadowsOnce) {
  proves({"IU.6-4"}, Oracle::program, "obstructed_form_factor at 1e-7, two overlapping shadows");
  constexpr double kAsked = 1e-3;
  const std::vector<Polygon> blockers{rectangle({0.6, 0.4, 0.6}, {0.5, 0.1, 0}, {-0.1, 0.4, 0.1}),
                                      rectangle({0.5, 0.2, 0.7}, {0, 0.6, 0}, {0, 0, 0.3})};
  const auto f = certified_form_factor(kFloor, kCeiling, blockers, to_relative(kAsked, 400'000));
  const Bounded engine = obstructed_form_factor(kFloor, kCeiling, blockers, {1e-7, 0});
  EXPECT_TRUE(holds(engine.value + engine.bound >= f.factor.lower && engine.value - engine.bound <= f.factor.upper));
  EXPECT_TRUE(within(0.5 * f.factor.width(), kAsked * f.factor.middle()));
}

// CLAIM      IU.6-4: past three leaning blockers, two that share an edge and two that pierce one another, the enclosure
//            holds what rays find.
// ORACLE     statistics: 50 625 stratified point pairs, seed fixed.
// TOLERANCE  5 standard errors of the plain estimator, which stratification only lowers.
TEST(CertifiedObstruction, HoldsWhatRaysFind) {
  proves({"IU.6-4"}, Oracle::statistics, "50 625 stratified point pairs, 5 standard errors, three scenes");
  uses_seed(kSeed + 2);
  const std::vector<std::vector<Polygon>> scenes{
      leaning_blockers(),
      {rectangle({0.3, 0.3, 0.4}, {0.4, 0, 0}, {0, 0.4, 0}), rectangle({0.3, 0.3, 0.4}, {0.4, 0, 0}, {0, 0, 0.3})},
      {rectangle({0.2, 0.2, 0.5}, {0.6, 0, 0}, {0, 0.6, 0.1}), rectangle({0.5, 0.1, 0.2}, {0, 0.7, 0}, {0, 0, 0.6})}};
  std::mt19937_64 random(kSeed + 2);
  for (const auto& blockers : scenes) {
    const auto [mean, error] = between_unit_squares(blockers, 15, [&] { return unit(random); });
    const auto f = certified_form_factor(kFloor, kCeiling, blockers, to_relative(1e-2, 100'000));
    EXPECT_TRUE(holds(f.factor.lower <= mean + 5 * error && mean - 5 * error <= f.factor.upper))
        << mean << " in [" << f.factor.lower << ", " << f.factor.upper << "]";
    EXPECT_TRUE(within(f.factor.width(), 0.1)) << "an enclosure that says nothing";
  }
}

// CLAIM      IU.6-4: a blocker that is not convex is refused.
// ORACLE     identity: the contract.
// TOLERANCE  none.
TEST(CertifiedObstruction, RefusesAConcaveBlocker) {
  proves({"IU.6-4"}, Oracle::identity, "the contract");
  const std::vector<Polygon> arrow{polygon({{0, 0, 0.5}, {1, 0, 0.5}, {0.3, 0.3, 0.5}, {0, 1, 0.5}})};
  EXPECT_TRUE(refuses([&] { (void)certified_form_factor(kFloor, kCeiling, arrow); }));
}

}  // namespace
}  // namespace etendue::validation
