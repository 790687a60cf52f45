// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/loop.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "etendue/form_factor/blocker.hpp"
#include "form_factor/shapes.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      a loop is clipped to what has no negative height: corners that are kept, crossings, none twice; what only touches
//            leaves nothing.
// ORACLE     identity: a square cut by lines, numbers without rounding.
// TOLERANCE  none.
TEST(Loop, IsClippedWithoutCornersTwice) {
  proves({}, Oracle::identity, "a square under nine half-planes");
  const std::vector<Vec3> square{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const auto cut = [&](double a, double b, double c) {  // a x + b y + c ≥ 0
    std::vector<double> heights;
    for (const Vec3& v : square) heights.push_back(a * v.x() + b * v.y() + c);
    return clip(square, heights);
  };
  using Corners = std::vector<Vec3>;
  EXPECT_TRUE(holds(cut(0, 0, 1) == square && cut(1, 0, 0) == square && cut(1, 1, 0) == square));
  EXPECT_TRUE(holds(cut(0, 0, -1).empty() && cut(-1, 0, 0).empty() && cut(-1, -1, 0).empty()));
  EXPECT_TRUE(holds(cut(1, 0, -1) == Corners{{1, 0, 0}, {4, 0, 0}, {4, 4, 0}, {1, 4, 0}}));
  EXPECT_TRUE(holds(cut(-1, 1, 0) == Corners{{0, 0, 0}, {4, 4, 0}, {0, 4, 0}}));
  EXPECT_TRUE(holds(cut(-1, -1, 2) == Corners{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}));
}

// CLAIM      convex pieces of a concave polygon share it out: none turns the other way, none overlaps another.
// ORACLE     identity: no piece has a negative area, and the areas add up to the polygon's.
// TOLERANCE  1e-14 of the polygon's area, for some hundred roundings of its terms.
TEST(ConvexPieces, ShareOutAPolygon) {
  proves({}, Oracle::identity, "2000 star-shaped polygons, combs");
  constexpr std::uint64_t kSeed = 20261128;
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::uint64_t wrong = 0;
  constexpr std::uint64_t kPolygons = 2000;
  for (std::uint64_t i = 0; i < kPolygons; ++i) {
    const int n = 4 + static_cast<int>(i % 9);
    std::vector<Vec3> corners;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.8 * random.unit()) / n, reach = 0.1 + random.unit();
      corners.push_back({reach * std::cos(angle), reach * std::sin(angle), 0});
    }
    if (i % 10 == 0) {  // a comb, whose teeth stand before one another's ears
      corners = {{0, 0, 0},
                 {6, 0, 0},
                 {6, 5, 0},
                 {5, 1, 0},
                 {4, 5 * random.unit() + 1, 0},
                 {3, 1, 0},
                 {2, 5, 0},
                 {1, 0.5 + random.unit(), 0},
                 {0, 5, 0}};
    }
    const double whole = signed_area(corners), rounding = 1e-14 * std::abs(whole);
    double sum = 0;
    bool turned = false;
    for (const std::vector<std::size_t>& piece : convex_pieces(corners, Vec3::UnitZ())) {
      std::vector<Vec3> loop;
      for (const std::size_t k : piece) loop.push_back(corners[k]);
      turned = turned || signed_area(loop) < -rounding;
      sum += std::abs(signed_area(loop));
    }
    wrong += turned || !(std::abs(sum - whole) <= rounding) ? 1u : 0u;
  }
  EXPECT_TRUE(all_agree(wrong, kPolygons));
}

}  // namespace
}  // namespace etendue::validation
