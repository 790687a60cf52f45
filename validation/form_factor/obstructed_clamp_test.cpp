// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "etendue/form_factor/facing_pair.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/outer_integral.hpp"
#include "etendue/form_factor/sight_zone.hpp"
#include "form_factor/shapes.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20261126;
constexpr int kShafts = 100;

/// Two squares and what fills the section of the shaft between them to the last bit but rounding: nothing is seen.
struct FilledShaft {
  Polygon from, to;
  std::vector<Polygon> plates;
};

FilledShaft filled_shaft(CounterRandom& random, bool halves) {
  const double x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(0.2, 2);
  const double side = random.between(0.3, 1.5), share = random.between(0.1, 0.9);
  const Vec3 o = share * Vec3(x, y, z), b(0, 1 + share * (side - 1), 0);
  const Vec3 a(halves ? 0.5 * b.y() : b.y(), 0, 0);
  FilledShaft shaft{tilted(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})),
                    tilted(rectangle({x, y, z}, {0, side, 0}, {side, 0, 0})),
                    {tilted(rectangle(o, a, b))}};
  if (halves) shaft.plates.push_back(tilted(rectangle(o + a, a, b)));
  return shaft;
}

/// The integral as it stood before it was moved into its range: refined as often as `f` was.
double before_clamping(const FilledShaft& shaft, const ObstructedFormFactor& f, double asked) {
  const FacingPair pair = facing_pair(shaft.from, shaft.to);
  std::vector<Blocker> made;
  std::vector<const Blocker*> blockers;
  for (const Polygon& plate : shaft.plates) made.push_back(Blocker::plate(plate));
  for (const Blocker& blocker : made) blockers.push_back(&blocker);
  const SightSpace space = sight_space(pair, shaft.from.vertices().front(), blockers);
  OuterIntegral outer(space, f.free.value * pair.from_area, 0.5 * asked * f.free.value * pair.from_area);
  while (outer.evaluations() < f.evaluations) outer.refine();
  const double integral = outer.value() / pair.from_area;
  return outer.integrand() == Integrand::hidden ? f.free.value - integral : integral;
}

// CLAIM      IU.6-4: a value that leaves [0, free] is put back on the nearer end, `clamp` says which and `clamped_by` by how
//            much, no more than the bound, which holds; a value inside is left alone and nothing is said.
// ORACLE     exact: the outer integral refined as often, before it is clamped; the truth is 0.
// TOLERANCE  kFrame: the tilted frame opens slits of a rounding's width, and two ways into the source's frame differ by
//            roundings; on the truth, the returned bound as well.
TEST(ObstructedClamp, SaysWhatItMovedAndByHowMuch) {
  proves({"IU.6-4"}, Oracle::exact, "100 shafts filled exactly by one plate or two, at three tolerances");
  constexpr double kFrame = 64 * 0x1p-53;
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::array<int, 3> seen{};
  std::uint64_t wrong = 0, decisions = 0;
  for (int i = 0; i < kShafts; ++i) {
    const FilledShaft shaft = filled_shaft(random, i % 2 == 1);
    for (const double asked : {0.5, 1e-2, 1e-4}) {
      const ObstructedFormFactor f = obstructed_form_factor(shaft.from, shaft.to, shaft.plates, {asked, 0});
      const double before = before_clamping(shaft, f, asked);
      const double inside = f.clamp == Clamp::to_zero ? -f.clamped_by : f.value + f.clamped_by;
      EXPECT_TRUE(near(inside, before, kFrame)) << i << ' ' << asked;
      EXPECT_TRUE(near(f.value, 0, f.bound + kFrame)) << i << ' ' << asked;
      wrong += (f.clamp == Clamp::none) != (f.clamped_by == 0) || !(f.clamped_by <= f.bound);
      wrong += f.clamp == Clamp::to_zero && f.value != 0;
      wrong += f.clamp == Clamp::to_free && f.value != f.free.value;
      wrong += !(0 <= f.value && f.value <= f.free.value);
      decisions += 4;
      ++seen[static_cast<std::size_t>(f.clamp)];
    }
  }
  EXPECT_TRUE(all_agree(wrong, decisions));
  EXPECT_GT(seen[static_cast<std::size_t>(Clamp::to_zero)], kShafts / 20);
  EXPECT_GT(seen[static_cast<std::size_t>(Clamp::none)], kShafts);
}

/// A box with its foot on the unit square z = 0, its lower corner in (x, y).
Blocker box_on_the_floor(double x, double y, double side, double height) {
  std::array<Vec3, 8> v;
  for (std::size_t k = 0; k < 8; ++k) {
    v[k] = tilted(Vec3(x + (k % 2 == 1 ? side : 0), y + (k / 2 % 2 == 1 ? side : 0), k / 4 == 1 ? height : 0));
  }
  return Blocker::solid(block(v)).value();
}

// CLAIM      IU.6-4: a value that exceeds the free factor is put back on it, `clamp` says so, and the bound holds: past boxes so
//            flat and small that they hide less than the quadrature of what is seen errs by.
// ORACLE     identity: 0 ≤ F_free − F ≤ the box's surface over the source's, since what is hidden passes through it.
// TOLERANCE  the returned bound, the box's surface, kFrame.
TEST(ObstructedClamp, HoldsValuesAtTheFreeFactor) {
  proves({"IU.6-4"}, Oracle::identity, "100 squares with a speck of a box on them, at three tolerances");
  constexpr double kFrame = 64 * 0x1p-53;
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::uint64_t wrong = 0, decisions = 0, acted = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(0.2, 2);
    const double size = random.between(0.3, 1.5), side = random.scale(1e-8, 1e-2), height = random.scale(1e-8, 1e-4);
    const double at_x = random.between(0.1, 0.8), at_y = random.between(0.1, 0.8);
    const Polygon from = tilted(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    const Polygon to = tilted(rectangle({x, y, z}, {0, size, 0}, {size, 0, 0}));
    const Blocker box = box_on_the_floor(at_x, at_y, side, height);
    const Blocker* const one = &box;
    const double surface = side * (side + 4 * height);
    for (const double asked : {0.5, 1e-2, 1e-4}) {
      const ObstructedFormFactor f = obstructed_form_factor(from, to, {&one, 1}, {asked, 0});
      EXPECT_TRUE(near(f.value, f.free.value, f.bound + surface + kFrame)) << i << ' ' << asked;
      wrong += f.clamp == Clamp::to_free && (f.value != f.free.value || !(f.clamped_by > 0 && f.clamped_by <= f.bound));
      wrong += !(0 <= f.value && f.value <= f.free.value);
      acted += f.clamp == Clamp::to_free ? 1u : 0u;
      decisions += 2;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decisions));
  EXPECT_GT(acted, 50u);
}

}  // namespace
}  // namespace etendue::validation
