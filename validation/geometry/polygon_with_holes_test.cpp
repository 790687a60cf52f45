// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/polygon_with_holes.hpp"

#include <limits>

#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kRays = 60'000;

// A concave outline with three holes, one of them concave, one a triangle; corners on a grid of halves.
const std::vector<Vec3> kOutline{{0, 0, 0}, {8, 0, 0}, {8, 6, 0}, {5, 6, 0}, {5, 4, 0}, {0, 4, 0}};
const std::vector<std::vector<Vec3>> kHoles{{{1, 1, 0}, {2, 1, 0}, {2, 3, 0}, {1, 3, 0}},
                                            {{3, 1, 0}, {3, 3, 0}, {4.5, 3, 0}, {3.5, 2, 0}, {4.5, 1, 0}},
                                            {{6, 1, 0}, {7, 5, 0}, {6, 5, 0}}};

std::vector<Vec3> moved(std::vector<Vec3> chain, const Mat3& frame, const Vec3& offset) {
  for (Vec3& v : chain) v = frame * v + offset;
  return chain;
}

// Is (x, y) inside the chain? For points off the lines x = corner and y = corner: counted crossings, all exact.
bool inside(const std::vector<Vec3>& chain, double x, double y) {
  bool in = false;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Vec3 &a = chain[i], &b = chain[(i + 1) % chain.size()];
    if ((a.y() > y) == (b.y() > y)) continue;
    const double across = (b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y());
    if ((b.y() > a.y()) == (across > 0)) in = !in;
  }
  return in;
}

// CLAIM      IU.5.6.2: a ray hits a polygon with holes where it passes through the outline and through none of the
//            holes; t is the height over the plane.
// ORACLE     closed form: crossings counted on a grid that no corner lies on; all its numbers are small dyadic ones.
// TOLERANCE  none.
TEST(PolygonWithHoles, IsWhatTheHolesLeave) {
  proves({"IU.5.6.2", "IU.5.0"}, Oracle::closed_form, "crossings counted on a dyadic grid");
  const auto polygon = PolygonWithHoles::make(Polygon::make(kOutline).value(), kHoles);
  ASSERT_TRUE(polygon.ok()) << polygon.error().message;
  std::uint64_t wrong = 0, decided = 0, met = 0;
  for (int i = -8; i < 140; ++i) {
    for (int j = -8; j < 110; ++j) {
      const double x = i / 16.0 + 1.0 / 32, y = j / 16.0 + 1.0 / 64;
      bool expected = inside(kOutline, x, y);
      for (const auto& hole : kHoles) expected = expected && !inside(hole, x, y);
      // Slanted by dyadic numbers: the ray meets the plane in (x, y) at t = 2.
      const auto hit = intersect(Ray{{x + 2, y - 1, 4}, {-1, 0.5, -2}}, *polygon);
      ++decided;
      met += expected;
      wrong += hit.has_value() != expected || (hit && (hit->t != 2 || hit->point != Vec3(x, y, 0)));
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_GT(met, 5000u);
  // Shoelace: 8·4 + 3·2, less 2, 3 − 1, and 2.
  EXPECT_TRUE(near(polygon->area(), 38.0 - 2 - 2 - 2, 0));
}

// CLAIM      IU.5.6.2: with plugs of exactly the same corners in its holes, a ray through the outline hits exactly one,
//            aimed at edges and corners of the holes, in random frames, near and far.
// ORACLE     topology: the plugs and the polygon tile the outline.
// TOLERANCE  none.
TEST(PolygonWithHoles, LeavesNoGapAroundItsPlugs) {
  proves({"IU.5.6.2", "IU.5.0"}, Oracle::identity, "the plugs and the polygon tile the outline");
  Random random(623);
  std::uint64_t wrong = 0, rays = 0;
  for (const double away : {0.0, 3e5}) {
    for (int frame = 0; frame < 20; ++frame) {
      const Mat3 turn = random.rotation();
      const Vec3 offset = turn * Vec3(away, 0, 0);
      std::vector<std::vector<Vec3>> holes;
      for (const auto& hole : kHoles) holes.push_back(moved(hole, turn, offset));
      const auto pierced = PolygonWithHoles::make(Polygon::make(moved(kOutline, turn, offset)).value(), holes);
      ASSERT_TRUE(pierced.ok()) << pierced.error().message;
      std::vector<Polygon> plugs;
      for (const auto& hole : holes) plugs.push_back(Polygon::make(hole).value());
      for (std::uint64_t i = 0; i < kRays / 40; ++i) {
        const auto& hole = holes[random.index(holes.size())];
        const std::size_t corner = random.index(hole.size());
        const double share = i % 2 == 0 ? 0 : random.uniform(0, 1);
        const Vec3 target = hole[corner] + share * (hole[(corner + 1) % hole.size()] - hole[corner]);
        Ray ray;
        ray.origin = offset + turn * (Vec3(4, 2, 5) + random.in_cube(4));
        ray.direction = target - ray.origin;
        int hits = intersect(ray, *pierced).has_value() ? 1 : 0;
        for (const Polygon& plug : plugs) hits += intersect(ray, plug).has_value() ? 1 : 0;
        ++rays;
        wrong += hits != 1;
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, rays));
}

// CLAIM      What is no hole is refused: each message names the hole, and what is wrong with it.
// ORACLE     exact: polygons with one fault each.
// TOLERANCE  none.
TEST(PolygonWithHoles, RefusesWhatIsNoHole) {
  proves({"IU.5.6.2"}, Oracle::exact, "polygons with one fault each");
  const Polygon square = Polygon::make({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}).value();
  const auto message = [&](const std::vector<std::vector<Vec3>>& holes) {
    const auto made = PolygonWithHoles::make(square, holes);
    return made ? "accepted" : made.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> small{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  const std::vector<std::pair<std::vector<std::vector<Vec3>>, std::string>> faults{
      {{small, {{5, 1, 0}, {6, 1, 0}, {5, 2, 0}}}, "polygon: hole 1 lies outside the polygon"},
      {{{{-1, -1, 0}, {5, -1, 0}, {5, 5, 0}, {-1, 5, 0}}}, "polygon: hole 0 lies outside the polygon"},
      {{{{3, 1, 0}, {5, 1, 0}, {3, 2, 0}}},
       "polygon: hole 0 crosses or touches the outline: edges (3, 1, 0) to (5, 1, 0) and (4, 0, 0) to (4, 4, 0)"},
      {{{{1, 0, 0}, {2, 1, 0}, {1, 2, 0}}},
       "polygon: hole 0 crosses or touches the outline: edges (1, 0, 0) to (2, 1, 0) and (0, 0, 0) to (4, 0, 0)"},
      {{small, {{1.5, 1.5, 0}, {3, 1.5, 0}, {3, 3, 0}}},
       "polygon: hole 1 crosses or touches hole 0: edges (1.5, 1.5, 0) to (3, 1.5, 0) and (2, 1, 0) to (2, 2, 0)"},
      {{small, {{1.25, 1.25, 0}, {1.75, 1.25, 0}, {1.5, 1.75, 0}}}, "polygon: hole 1 lies within hole 0"},
      {{small, {{0.5, 0.5, 0}, {3, 0.5, 0}, {3, 3, 0}, {0.5, 3, 0}}}, "polygon: hole 0 lies within hole 1"},
      {{{{1, 1, 0.25}, {2, 1, 0.25}, {2, 2, 0.25}}},
       "polygon: hole 0: vertex 0 = (1, 1, 0.25) is 0.25 off the polygon's plane; 3.64153e-12 is allowed"},
      {{{{1, 1, 0}, {2, 1, 0}, {3, 1, 0}}}, "polygon: hole 0: has no area"},
      {{{{1, 1, 0}, {2, 2, 0}, {2, 1, 0}, {1, 2, 0}}}, "polygon: hole 0: edges 0-1 (1, 1, 0) to (2, 2, 0) and 2-3"},
      {{{{1, 1, 0}, {2, 1, 0}}}, "polygon: hole 0: has 2 vertices; at least 3 are needed"},
      {{{{1, 1, 0}, {2, 1, nan}, {2, 2, 0}}}, "polygon: hole 0: vertex 1 = (2, 1, nan) is not finite"},
  };
  std::uint64_t wrong = 0;
  for (const auto& [holes, words] : faults) {
    const std::string found = message(holes);
    if (found.find(words) == 0) continue;
    ++wrong;
    ADD_FAILURE() << found << "\nexpected " << words;
  }
  EXPECT_TRUE(all_agree(wrong, faults.size()));
  EXPECT_TRUE(holds(message({small, {{3, 3, 0}, {3, 3.5, 0}, {3.5, 3, 0}}}) == "accepted"));
}

}  // namespace
}  // namespace etendue::validation
