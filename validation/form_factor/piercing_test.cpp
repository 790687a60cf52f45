// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// Seven times a rotation, in integers: dyadic points stay exact, the unit normals are no doubles.
Vec3 turned(double x, double y, double z) {
  return {2 * x + 3 * y + 6 * z, 3 * x - 6 * y + 2 * z, 6 * x + 2 * y - 3 * z};
}

/// The square [low, 1]² in the turned plane z = 0.
Polygon turned_floor(double low) {
  return polygon({turned(low, low, 0), turned(1, low, 0), turned(1, 1, 0), turned(low, 1, 0)});
}

/// Over [from, 1] × [0, 1], facing down, at the height slope · (x − 0.3125).
Polygon turned_panel(double from, double slope) {
  const double near = slope * (from - 0.3125), far = slope * 0.6875;
  return polygon({turned(from, 0, near), turned(from, 1, near), turned(1, 1, far), turned(1, 0, far)});
}

// CLAIM      G12: the part of a panel behind the floor's plane is cut off, whatever the angle between the two.
// ORACLE     identity: the same panel, cut by hand where it meets the plane; every coordinate is exact.
// TOLERANCE  the two returned bounds; they stay below 1e-12, as the crossing of exact input is not uncertain.
TEST(FormFactor, CutsPanelsThatPierceAtSmallAngles) {
  proves({"G12", "IU.6-3"}, Oracle::identity, "panels cut by hand, slopes 2^-4 to 2^-34, a frame with inexact normals");
  constexpr double kCrossing = 0.3125, kSharp = 1e-12;
  for (double low : {-1.0, 0.0}) {
    const Polygon floor = turned_floor(low);
    for (int bits = 4; bits <= 34; bits += 5) {
      const double slope = std::ldexp(1.0, -bits);
      const Polygon pierces = turned_panel(0, slope), by_hand = turned_panel(kCrossing, slope);
      const Bounded up = form_factor(floor, pierces), up_by_hand = form_factor(floor, by_hand);
      EXPECT_TRUE(near(up.value, up_by_hand.value, up.bound + up_by_hand.bound)) << low << " 2^-" << bits;
      const Bounded down = form_factor(pierces, floor), down_by_hand = form_factor(by_hand, floor);
      const double share = 1 - kCrossing;  // of the panel's area
      EXPECT_TRUE(near(down.value, share * down_by_hand.value, down.bound + share * down_by_hand.bound));
      EXPECT_TRUE(within(up.bound, kSharp)) << low << " 2^-" << bits;
    }
  }
}

// CLAIM      G12: a polygon a hair in front of another sees it, one a hair behind does not.
// ORACLE     identity: between plates at a distance far below their size, F = 1; behind, F = 0.
// TOLERANCE  the returned bound, and 4 distance/side for the open rim; the zeros and their bounds are exact.
TEST(FormFactor, TellsFrontFromBehindAtAnyDistance) {
  proves({"G12", "IU.6-3"}, Oracle::identity, "unit plates 1e-13 to 1e-30 apart, in front and behind");
  constexpr double kUseful = 1e-9;
  const Polygon floor = rectangle({-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0});
  for (double z : {1e-13, 1e-15, 1e-17, 1e-30}) {
    const Bounded over = form_factor(floor, rectangle({-0.5, -0.5, z}, {0, 1, 0}, {1, 0, 0}));
    EXPECT_TRUE(near(over.value, 1, over.bound + 4 * z)) << z;
    EXPECT_TRUE(within(over.bound, kUseful)) << z;
    const Bounded under = form_factor(floor, rectangle({-0.5, -0.5, -z}, {0, 1, 0}, {1, 0, 0}));
    EXPECT_TRUE(within(under.value + under.bound, 0)) << z;
    const double s = 2 * z;
    const Bounded speck = form_factor(rectangle({-z, -z, z}, {0, s, 0}, {s, 0, 0}), floor);
    EXPECT_TRUE(near(speck.value, 1, speck.bound)) << z;
  }
  const Bounded backs = form_factor(floor, rectangle({-0.5, -0.5, 0}, {0, 1, 0}, {1, 0, 0}));
  EXPECT_TRUE(within(backs.value + backs.bound, 0)) << "the two sides of one surface";
}

// CLAIM      IU.6-3: what is behind, or the other side of the same surface, is known to be unseen also in a frame that rounds all corners,
//            whichever corner comes first.
// ORACLE     identity: F = 0.
// TOLERANCE  none, of the bound either.
TEST(FormFactor, IsExactlyNothingBehindInAnyFrame) {
  proves({"G12", "IU.6-3"}, Oracle::identity, "60 tilted sheets and patches behind them");
  std::uint64_t wrong = 0;
  constexpr std::uint64_t kSheets = 60;
  for (std::uint64_t k = 0; k < kSheets; ++k) {
    const double size = 0.3 + 0.07 * static_cast<double>(k), x = 0.1 * static_cast<double>(k % 7);
    const Polygon sheet = tilted(rectangle({x, 0.2, 0.7}, {size, 0, 0}, {0, 0.6 * size, 0}));
    const Polygon behind = tilted(rectangle({x + 0.1, 0, 0.7 - 0.3 * size}, {0, size, 0}, {size, 0, 0.2 * size}));
    std::vector<Vec3> corners = sheet.vertices();
    std::reverse(corners.begin(), corners.end());
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(k % 4), corners.end());
    for (const Polygon& other : {polygon(corners), behind}) {
      const Bounded there = form_factor(sheet, other), back = form_factor(other, sheet);
      wrong += there.value + there.bound != 0 || back.value + back.bound != 0 ? 1u : 0u;
    }
  }
  EXPECT_TRUE(all_agree(wrong, 2 * kSheets));
}

// CLAIM      IU.6.2: patches of one wall in a frame that rounds them exchange nothing, and the bound knows it.
// ORACLE     identity: a plane does not see itself.
// TOLERANCE  zero for the value; kRounding for the bound.
TEST(FormFactor, KeepsNeighboursInAWallApart) {
  proves({"IU.6.2"}, Oracle::identity, "neighbours in a tilted wall: 0 and a bound below 1e-15");
  constexpr double kRounding = 1e-15;
  for (int i = 1; i < 8; ++i) {
    const Bounded f = form_factor(tilted(rectangle({0, 0, 0}, {0.3, 0, 0}, {0, 0.7, 0})),
                                  tilted(rectangle({0.3 * i, 0.1, 0}, {0.3, 0, 0}, {0, 0.7, 0})));
    EXPECT_TRUE(within(f.value, 0));
    EXPECT_TRUE(within(f.bound, kRounding));
  }
}

}  // namespace
}  // namespace etendue::validation
