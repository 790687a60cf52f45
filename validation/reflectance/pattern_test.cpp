// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/pattern.hpp"

#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.4-1, of a procedure in place of a file: squares alternate along both edges, in any position; across the plane nothing
//            changes, so that a point that lies beside the plane by rounding has the colour of the square.
// ORACLE     identity: the parity of two integers.
// TOLERANCE  none: points lie an eighth of a square from its edges at least.
TEST(Pattern, AlternatesSquares) {
  proves({"IU.4-1"}, Oracle::identity, "parity of the square's numbers");
  Checkerboard board;
  board.origin = {0.3, -0.2, 7};
  board.u = Vec3(1, 2, 2) / 3;
  board.v = Vec3(2, 1, -2) / 3;
  board.size = 0.4;
  const Vec3 across = board.u.cross(board.v);
  std::uint64_t wrong = 0, compared = 0;
  for (int i = -5; i <= 5; ++i) {
    for (int j = -5; j <= 5; ++j) {
      for (const double off : {-0.375, 0.0, 0.375}) {
        for (const double height : {-1e-17, 0.0, 0.3, 1e5}) {
          const Vec3 point =
              board.origin + board.size * ((i + 0.5 + off) * board.u + (j + 0.5 - off) * board.v) + height * across;
          const double expected = ((i + j) % 2 + 2) % 2;
          wrong += second_share(board, point) != expected ? 1u : 0u;
          ++compared;
        }
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, compared));
}

// CLAIM      IU.4-1: wood shows rings around its axis, each darkening outwards, that bend along the trunk and around it.
// ORACLE     closed form: (r/a − ⌊r/a⌋)² where both sines are zero; with both one, half a ring farther.
// TOLERANCE  the square's slope, 2, times the roundings of r/a, which is below 16: of the frame, the norm and the quotient.
TEST(Pattern, GrowsRings) {
  proves({"IU.4-1"}, Oracle::closed_form, "squares of fractions of rings");
  Wood wood;
  wood.origin = {1, 2, 3};
  wood.axis = Vec3(2, -1, 2) / 3;
  wood.ring = 0.05;
  const TangentFrame frame = tangent_frame(wood.axis);
  constexpr double kTolerance = 2 * 16 * 64 * kUnitRoundoff;
  const double bent = 16.0 / 7 * wood.ring * std::numbers::pi / 2;  // where the sine along the trunk is one
  const double lobe = std::numbers::pi / 6;                         // where the sine around it is one
  for (double rings = 0.3; rings < 15; rings += 0.4375) {
    const double share = rings - std::floor(rings);
    const double radius = rings * wood.ring;
    EXPECT_TRUE(near(second_share(wood, wood.origin + radius * frame.u), share * share, kTolerance)) << rings;
    const Vec3 out = std::cos(lobe) * frame.u + std::sin(lobe) * frame.v;
    const double farther = rings + 0.5 - std::floor(rings + 0.5);
    const double found = second_share(wood, wood.origin + bent * wood.axis + radius * out);
    EXPECT_TRUE(near(found, farther * farther, kTolerance)) << rings;
  }
}

}  // namespace
}  // namespace etendue::validation
