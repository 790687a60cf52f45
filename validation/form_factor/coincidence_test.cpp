// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// Areas are rounded where polygons are made.
constexpr double kFrame = 1e-15;

struct Obstructed {
  std::vector<Vec3> from, to;
  std::vector<std::vector<Vec3>> plates;
};

// Small whole numbers, in which from the middle of a cell edges meet in the view that have nothing to do with one another.
const std::array<Obstructed, 9> kOnTheGrid{{
    {{{2, 1, 1}, {2, 1, 2}, {1, 1, 2}},
     {{0, 0, 2}, {2, 0, 0}, {1, 0, 0}},
     {{{0, 0, 1}, {1, 2, 2}, {1, 1, 0}},
      {{0, 1, 0}, {2, 2, 2}, {2, 1, 2}},
      {{2, 2, 1}, {0, 2, 2}, {1, 2, 1}},
      {{1, 0, 0}, {1, 2, 0}, {1, 2, 1}, {1, 0, 1}}}},
    {{{0, 2, 1}, {1, 0, 1}, {2, 1, 0}},
     {{1, 1, 1}, {1, 2, 1}, {1, 2, 2}, {1, 1, 2}},
     {{{0, 0, 1}, {1, 0, 0}, {2, 1, 2}}, {{1, 2, 2}, {2, 1, 1}, {0, 1, 0}}, {{0, 2, 0}, {0, 0, 2}, {2, 0, 1}}}},
    {{{1, 2, 0}, {1, 2, 3}, {2, 2, 3}, {2, 2, 0}},
     {{0, 3, 1}, {2, 0, 3}, {2, 2, 0}},
     {{{3, 0, 3}, {0, 1, 1}, {2, 0, 0}},
      {{1, 2, 1}, {0, 3, 2}, {3, 3, 1}},
      {{3, 1, 3}, {3, 2, 2}, {2, 1, 3}},
      {{3, 0, 0}, {1, 3, 2}, {2, 0, 3}}}},
    // Curves of three edges that chords follow too loosely for what is asked in the end.
    {{{1, 3, 1}, {2, 3, 1}, {2, 2, 3}},
     {{0, 1, 3}, {2, 1, 0}, {0, 0, 2}},
     {{{3, 2.5, 0}, {2, 2, 0}, {1, 3, 3}}, {{3, 2.5, 0}, {1, 3, 3}, {3, 0, 2}}, {{3, 2.5, 0}, {3, 0, 2}, {0, 2, 1}}}},
    {{{0, 1, 0}, {1, 1, 1}, {0, 0, 0}},
     {{0, 0, 1}, {0, 0, 2}, {2, 0, 2}, {2, 0, 1}},
     {{{2, 0, 1}, {0, 1, 2}, {1, 1, 1}},
      {{1, 0, 2}, {1, 1, 1}, {1, 1, 0}},
      {{0, 1, 2}, {2, 1, 2}, {2, 2, 2}, {0, 2, 2}}}},
    // A plate's corner in the source's plane all but touches a thin cell: at that end what is seen changes by powers of ten
    // within less than the way to the first node of any rule.
    {{{2, 3, 2}, {3, 1, 0}, {1, 1, 0}},
     {{1, 0, 3}, {3, 3, 0}, {0, 0, 2}},
     {{{1, 3, 1}, {2, 3, 1}, {1, 0, 1}}, {{3, 0, 1}, {2, 3, 1}, {0, 0, 0}}}},
    {{{1, 2, 1}, {1, 0, 1}, {0, 2, 0}},
     {{2, 1, 0}, {1, 1, 2}, {0, 1, 1}},
     {{{2, 0, 1}, {2, 0, 2}, {1, 2, 2}}, {{1, 1, 1}, {2, 0, 0}, {1, 0, 2}}}},
    {{{3, 1, 3}, {2, 0, 2}, {0, 2, 1}},
     {{1, 2, 2}, {1, 1, 1}, {0, 1, 2}},
     {{{0.5, 2, 1}, {1, 3, 1}, {3, 3, 3}}, {{0.5, 2, 1}, {3, 3, 3}, {3, 3, 2}}, {{0.5, 2, 1}, {3, 3, 2}, {2, 0, 3}}}},
    // A curve that crosses a dark cell beyond all nodes.
    {{{2, 2, 1}, {0, 0, 0}, {2, 2, 2}},
     {{1, 0, 0}, {1, 2, 2}, {0, 0, 2}},
     {{{2, 1, 2}, {1, 0, 1}, {1, 2, 1}}, {{0, 2, 2}, {2, 0, 2}, {0, 2, 1}}, {{1, 1, 2}, {2, 1, 2}, {1, 1, 0}}}},
}};

/// Both sides of a pair, as shares of `from`.
struct Exchange {
  Bounded there, back;
  double bounds() const { return there.bound + back.bound; }
};

Exchange exchange(const Polygon& from, const Polygon& to, const std::vector<Polygon>& plates, Tolerance asked) {
  Exchange e{obstructed_form_factor(from, to, plates, asked), obstructed_form_factor(to, from, plates, asked)};
  const double share = to.area() / from.area();
  e.back = {share * e.back.value, share * e.back.bound};
  return e;
}

// CLAIM      IU.6-4, IU.6-5: in scenes on a grid, where lines of sight pass through several edges at once, the bound holds: both sides
//            agree, and a plate more never lets more light through.
// ORACLE     metamorphic: reciprocity; F past some of the plates ≥ F past all.
// TOLERANCE  the returned bounds, kFrame.
TEST(Coincidence, OnAGridKeepsTheBound) {
  proves({"IU.6-4", "IU.6-5"}, Oracle::metamorphic,
         "nine pairs that grids make hard, and 400 random ones, both sides at 1e-4 and 1e-8");
  constexpr std::uint64_t kSeed = 20261126;
  uses_seed(kSeed);
  Random random(kSeed);
  std::vector<Obstructed> scenes(kOnTheGrid.begin(), kOnTheGrid.end());
  const auto triangle = [&] {
    for (;;) {
      std::vector<Vec3> corners;
      for (int k = 0; k < 3; ++k) corners.push_back(random.dyadic(1, 0) + Vec3(1, 1, 1));
      if (Polygon::make(corners)) return corners;
    }
  };
  while (scenes.size() < 400 + kOnTheGrid.size()) {
    Obstructed scene{triangle(), triangle(), {}};
    for (std::size_t k = 0; k < 2 + scenes.size() % 2; ++k) scene.plates.push_back(triangle());
    scenes.push_back(std::move(scene));
  }
  int partly = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Polygon from = polygon(scenes[i].from), to = polygon(scenes[i].to);
    std::vector<Polygon> plates;
    for (const auto& corners : scenes[i].plates) plates.push_back(polygon(corners));
    for (const double asked : {1e-4, 1e-8}) {
      const Exchange all = exchange(from, to, plates, {asked, 1e-12});
      EXPECT_TRUE(near(all.there.value, all.back.value, all.bounds() + kFrame)) << i << ' ' << asked;
      const Exchange fewer = exchange(from, to, {plates.begin() + 1, plates.end()}, {asked, 1e-12});
      EXPECT_TRUE(
          within(std::max(0.0, all.there.value - fewer.there.value), all.there.bound + fewer.there.bound + kFrame))
          << i;
      EXPECT_TRUE(within(std::max(0.0, all.back.value - fewer.back.value), all.back.bound + fewer.back.bound + kFrame))
          << i;
      const double free = form_factor(from, to, {1e-9, 0}).value;
      partly += all.there.value > 1e-3 * free && all.there.value < 0.999 * free;
    }
  }
  EXPECT_GT(partly, 60);
}

std::array<Vec3, 8> corners_of(const Vec3& low, const Vec3& high) {
  std::array<Vec3, 8> v;
  const std::array<Vec3, 2> ends{low, high};
  for (std::size_t k = 0; k < 8; ++k) v[k] = {ends[k & 1].x(), ends[k / 2 & 1].y(), ends[k / 4].z()};
  return v;
}

// CLAIM      IU.6-4, IU.6-5: a board that stands before another of its outline, at a small gap, hides the room from the face between
//            them however both are turned: its sides' planes hold that face's edges but for their rounding.
// ORACLE     metamorphic: the boards as they stand on the axes, with the board's six faces as single plates; both sides.
// TOLERANCE  the returned bounds; kTurned of the free factor, 64 roundings of corners of size 3 over the gap.
TEST(Coincidence, OfASourceAndTheSidesOfASolidIsNotSeen) {
  proves({"IU.6-4", "IU.6-5"}, Oracle::metamorphic, "flush boards at gaps of 0.01 to 0.5, 60 turns, both sides");
  constexpr std::uint64_t kSeed = 20261127;
  constexpr double kTurned = 64 * 3 / 0.01 * 0x1p-53;
  uses_seed(kSeed);
  Random random(kSeed);
  for (const auto& [thick, gap] :
       {std::pair(0.01, 0.01), std::pair(0.5, 0.01), std::pair(0.1, 0.03), std::pair(0.5, 0.5)}) {
    const std::vector<Vec3> face{{1.5, 1.5, 0.2}, {1.5 - thick, 1.5, 0.2}, {1.5 - thick, 1.5, 2.8}, {1.5, 1.5, 2.8}};
    const std::vector<Vec3> wall{{0, 0, 0}, {0, 3, 0}, {0, 3, 3}, {0, 0, 3}};
    const auto corners = corners_of({1.5 - thick, 1.5 + gap, 0.2}, {1.5, 2.8, 2.8});
    const std::vector<Polygon> faces = block(corners);
    const Exchange still = exchange(polygon(face), polygon(wall), faces, {1e-6, 1e-9});
    EXPECT_TRUE(near(still.there.value, still.back.value, still.bounds() + kFrame));
    for (int turn = 0; turn < 15; ++turn) {
      const Mat3 frame = random.rotation();
      const auto first = static_cast<std::ptrdiff_t>(random.index(4));
      const auto turned = [&](std::vector<Vec3> points) {
        std::rotate(points.begin(), points.begin() + first, points.end());
        for (Vec3& p : points) p = frame * p;
        return points;
      };
      std::array<Vec3, 8> moved = corners;
      for (Vec3& p : moved) p = frame * p;
      const Blocker board = Blocker::solid(block(moved)).value();
      const Polygon from = polygon(turned(face)), to = polygon(turned(wall));
      const std::vector<const Blocker*> blockers{&board};
      const Bounded there = obstructed_form_factor(from, to, blockers, {1e-5, 1e-9});
      const Bounded back = obstructed_form_factor(to, from, blockers, {1e-5, 1e-9});
      const double share = to.area() / from.area();
      EXPECT_TRUE(near(there.value, still.there.value, there.bound + still.there.bound + kTurned))
          << thick << ' ' << gap;
      EXPECT_TRUE(near(share * back.value, still.there.value, share * back.bound + still.there.bound + kTurned))
          << thick;
    }
  }
}

// CLAIM      IU.6-4: where a table stands on its legs but for a rounding, or they reach into it by one, the underside sees a leg as if they
//            touched exactly; what a leg covers sees nothing.
// ORACLE     metamorphic: the table moved by −2 to 2 units in the last place of its height; the other side; a point of the underside
//            above a leg.
// TOLERANCE  the returned bounds, kFrame.
TEST(Coincidence, OfATableAndItsLegsIsContact) {
  proves({"IU.6-4"}, Oracle::metamorphic, "underside and one leg past two others, five heights, both sides");
  constexpr double kHeight = 1.2;
  std::vector<Blocker> legs;
  for (const auto& [x, y] : {std::pair(2.45, 0.35), std::pair(2.45, 0.75)}) {
    legs.push_back(Blocker::solid(block(corners_of({x, y, 0}, {x + 0.05, y + 0.05, kHeight}))).value());
  }
  const std::vector<const Blocker*> blockers{&legs[0], &legs[1]};
  const Polygon leg = rectangle({2.75, 0.35, 0}, {0, 0, kHeight}, {0, 0.05, 0});
  std::vector<Bounded> found;
  for (int ulps = -2; ulps <= 2; ++ulps) {
    const double height = kHeight + ulps * 0x1p-52;
    const Polygon under = rectangle({2.45, 0.35, height}, {0, 0.45, 0}, {0.35, 0, 0});
    const double share = leg.area() / under.area();
    const Bounded there = obstructed_form_factor(under, leg, blockers, {1e-6, 0});
    const Bounded back = obstructed_form_factor(leg, under, blockers, {1e-6, 0});
    EXPECT_TRUE(near(there.value, share * back.value, there.bound + share * back.bound + kFrame)) << ulps;
    found.push_back(there);
    const Bounded covered = visible_point_to_polygon({2.475, 0.375, height}, {0, 0, -1}, leg, blockers);
    EXPECT_TRUE(near(covered.value, 0, 0)) << ulps;
  }
  for (const Bounded& one : found) EXPECT_TRUE(near(one.value, found[2].value, one.bound + found[2].bound + kFrame));
}

// CLAIM      IU.6-4: a plate that lies in the source's plane but for the rounding of its corners hides nothing, wherever they are.
// ORACLE     identity: the free factor; the plate overlaps the source.
// TOLERANCE  the returned bounds.
TEST(Coincidence, WithTheSourcesPlaneHidesNothing) {
  proves({"IU.6-4"}, Oracle::identity,
         "100 rotated plates that overlap the source in its plane, small ones far from the origin too");
  constexpr std::uint64_t kSeed = 20261127;
  uses_seed(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 100; ++i) {
    const Mat3 turn = random.rotation();
    const double size = i % 2 == 0 ? 1 : 1e-3;
    const Vec3 shift = random.in_cube(1);
    const auto placed = [&](double x, double y, double z) { return Vec3(turn * (size * Vec3(x, y, z)) + shift); };
    const Polygon from = polygon({placed(0, 0, 0), placed(1, 0, 0), placed(1, 1, 0), placed(0, 1, 0)});
    const Polygon to = polygon({placed(0, 0, 1), placed(0, 1, 1), placed(1, 1, 1), placed(1, 0, 1)});
    const double a = random.uniform(-1, 0.5), b = random.uniform(0.5, 2);
    const std::vector<Polygon> plates{polygon({placed(a, a, 0), placed(b, 0.1, 0), placed(0.2, b, 0)})};
    const ObstructedFormFactor f = obstructed_form_factor(from, to, plates, {1e-8, 0});
    EXPECT_TRUE(near(f.value, f.free.value, f.bound + f.free.bound)) << i;
  }
}

}  // namespace
}  // namespace etendue::validation
