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
//            much, no more than the bound, which holds; a value inside is left alone and nothing is said. No pair is
//            known whose value exceeds the free factor, so that end is only kept under watch.
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

}  // namespace
}  // namespace etendue::validation
