// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/shadow_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "etendue/form_factor/certified_outline.hpp"
#include "etendue/form_factor/hull_flux.hpp"
#include "form_factor/shapes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

double area_of(const std::vector<ReceiverPiece>& pieces) {
  double sum = 0;
  for (const ReceiverPiece& piece : pieces) sum += std::abs(signed_area(piece));
  return sum;
}

std::vector<Vec3> square(double half, double height) {
  return {{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}};
}

// CLAIM      IU.6-4: past a square half-way between them the shadows of a triangle's points on a receiver are squares twice as large:
//            what all of them share, and what they cover together, in any unit of length, whichever side of the square is seen.
// ORACLE     closed form: for a right triangle of sides h the common part of squares of side s is (s − h)²; together they cover the
//            Minkowski sum, s² + 2 s h + h²/2.
// TOLERANCE  1e-9 of s²: blockers are drawn in by 2^-40 of the reach. The common part is no larger, the covered one no smaller, but for
//            the slivers that are counted.
TEST(ShadowHulls, AreThoseOfAllPointsOfATriangle) {
  proves({"IU.6-4"}, Oracle::closed_form, "Minkowski sum and erosion of a square by a triangle");
  constexpr double kSide = 0.5, kLeg = 0.125;
  for (const double unit : {0x1p-40, 1.0, 0x1p40}) {
    for (const bool turned : {false, true}) {
      for (const double up : {1.0, -1.0}) {
        const std::array<Vec3, 3> cell{Vec3::Zero(), Vec3(kLeg * unit, 0, 0), Vec3(0, kLeg * unit, 0)};
        std::vector<Vec3> plate = square(0.25 * kSide * unit, 0.5 * unit * up), receiver = square(unit, unit * up);
        std::vector<Vec3> floor = square(unit, 0);
        std::reverse(up > 0 ? receiver.begin() : floor.begin(), up > 0 ? receiver.end() : floor.end());
        if (turned) std::reverse(plate.begin(), plate.end());
        const ExactPlane from(floor), to(receiver);
        const double reach = 2 * unit;
        const std::vector<HullBlocker> blockers{hull_blocker(plate, from, to, kDrawnIn * reach)};
        ShadowHulls hulls(cell, blockers, reach);
        const double dark = area_of(hulls.inner(receiver)) / (unit * unit);
        const double shaded = area_of(hulls.outer(receiver)) / (unit * unit);
        const double common = (kSide - kLeg) * (kSide - kLeg);
        const double covered = kSide * kSide + 2 * kSide * kLeg + 0.5 * kLeg * kLeg;
        constexpr double kLost = 1e-9 * kSide * kSide;
        EXPECT_TRUE(near(dark, common, kLost)) << unit << turned << up;
        EXPECT_TRUE(near(shaded, covered, kLost)) << unit << turned << up;
        const double slivers = hulls.slivers() / (unit * unit);
        EXPECT_TRUE(holds(shaded >= covered - slivers && dark <= common + slivers)) << unit << turned << up;
        ReceiverPiece aside = square(0.1 * unit, unit * up);
        for (Vec3& v : aside) v.x() += 2 * unit;
        ShadowHulls other(cell, blockers, 4 * unit);
        EXPECT_TRUE(holds(other.outer(aside).empty() && other.inner(aside).empty())) << "beside all shadows";
      }
    }
  }
}

// CLAIM      IU.6-4: by shadow hulls a flux closes in as far as is asked, and no further; enclosures to several goals hold one number.
// ORACLE     identity: work and width of enclosures of one pair to several goals.
// TOLERANCE  half the width is no more than the goal, and no less than half of it: the cell that is quartered last takes no more.
TEST(HullPair, StopsAtItsGoal) {
  proves({"IU.6-4"}, Oracle::identity, "four goals from 0.1 to 0.01 for a flux of 0.07");
  const Polygon floor = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                ceiling = rectangle({0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  const EnclosedPair pair = enclosed_pair(floor, ceiling);
  const ExactPlane from(scaled(floor.vertices(), pair.scale)), to(scaled(ceiling.vertices(), pair.scale));
  const HullPair hulls(pair, from, to);
  const std::vector<std::vector<Vec3>> plate{
      scaled(rectangle({0.3, 0.3, 0.4}, {0.4, 0, 0.05}, {0, 0.4, 0}).vertices(), pair.scale)};
  std::int64_t before = 0;
  Interval common(0, 1);
  for (const double goal : {0.1, 0.05, 0.02, 0.01}) {
    const HiddenFlux found = hulls.hidden_flux(plate, goal, 1'000'000);
    EXPECT_TRUE(holds(0.5 * found.flux.width() <= goal && found.flux.width() >= goal)) << goal;
    EXPECT_TRUE(holds(found.work > before)) << found.work;
    common = {std::max(common.lower, found.flux.lower), std::min(common.upper, found.flux.upper)};
    before = found.work;
  }
  EXPECT_TRUE(holds(common.lower <= common.upper));
}

}  // namespace
}  // namespace etendue::validation
