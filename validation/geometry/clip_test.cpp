// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/clip.hpp"

#include <algorithm>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/predicates.hpp"
#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Vec3 vector_area(const std::vector<Vec3>& chain) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) sum += (chain[i] - chain[0]).cross(chain[i + 1] - chain[0]) / 2;
  return sum;
}

// CLAIM      IU.5.6.2: a concave polygon and the two parts a plane cuts it into have the same area vector, and every
//            corner of a part lies in front of the plane.
// ORACLE     identity: areas add up; exact: distances from the plane in rationals.
// TOLERANCE  4 u of the coordinates for a new corner, as documented; times the perimeter for the area.
TEST(Clip, PartsAddUpToTheWhole) {
  proves({"IU.5.6.2"}, Oracle::identity, "areas add up");
  Random random(1101);
  std::uint64_t cuts = 0, wrong = 0;
  for (int i = 0; i < 2'000; ++i) {
    const Mat3 frame = random.rotation();
    const Vec3 offset = random.in_cube(10);
    std::vector<Vec3> chain;
    for (const Vec2& p :
         {Vec2(0, 0), Vec2(6, 0), Vec2(6, 4), Vec2(5, 4), Vec2(5, 1), Vec2(1, 1), Vec2(1, 4), Vec2(0, 4)}) {
      chain.push_back(frame * Vec3(p.x(), p.y(), 0) + offset);
    }
    const Plane plane{chain[random.index(8)] + random.in_cube(2), random.unit_vector()};
    const auto front = clip(chain, plane), back = clip(chain, Plane{plane.point, -plane.normal});
    cuts += !front.empty() && !back.empty();
    const double corner = 4 * kUnitRoundoff * 17;
    EXPECT_TRUE(within((vector_area(front) + vector_area(back) - vector_area(chain)).norm(), 2 * 28 * corner));
    for (const Vec3& p : front) {
      const bool is_old = std::find(chain.begin(), chain.end(), p) != chain.end();
      const double distance = oracle::distance_to_plane(exact(p), exact(plane.point), exact(plane.normal));
      if (is_old) {
        wrong += side(p, plane) < 0;
      } else {
        EXPECT_TRUE(within(distance, corner));
        // Both parts are cut at the same point.
        wrong += std::find(back.begin(), back.end(), p) == back.end();
      }
    }
  }
  EXPECT_GT(cuts, 500u);
  EXPECT_TRUE(all_agree(wrong, cuts));
}

// CLAIM      IU.5.6.2: corners on the plane stay, what lies behind it goes, and nothing is left of a polygon behind it.
// ORACLE     closed form: the unit square.
// TOLERANCE  none.
TEST(Clip, KeepsWhatLiesInFront) {
  proves({"IU.5.6.2"}, Oracle::closed_form, "the unit square");
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto cut_at = [&](double x) { return clip(square, Plane{{x, 0, 0}, Vec3::UnitX()}); };
  EXPECT_TRUE(holds(cut_at(-1) == square));
  EXPECT_TRUE(holds(cut_at(0) == square));
  EXPECT_EQ(cut_at(0.25), (std::vector<Vec3>{{0.25, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.25, 1, 0}}));
  EXPECT_TRUE(holds(cut_at(1).empty())) << "an edge is no polygon";
  EXPECT_TRUE(holds(cut_at(2).empty()));
}

}  // namespace
}  // namespace etendue::validation
