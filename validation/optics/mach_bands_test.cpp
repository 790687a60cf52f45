// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/mach_bands.hpp"

#include <cmath>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// perceived()'s documented accuracy, for values up to 1 and a up to 2.
constexpr double kAccuracy = 3 * 0x1p-48;

// CLAIM      IU.3.1.1: a jump of intensity is perceived enlarged: darker on its dark side, brighter on its bright side; and so is a jump of
//            its slope. Fields and slopes that are uniform are perceived as they are.
// ORACLE     closed form: sums of the geometric weights beside a step and beside a bend.
// TOLERANCE  2^-48 (1 + a), as documented; the ends of the line are 400 pixels away, where r^400 < 1e-21.
TEST(MachBands, AreSeenBesideJumps) {
  proves({"IU.3.1.1"}, Oracle::closed_form, "geometric series beside a step and a bend");
  constexpr int kLength = 800, kMiddle = 400;
  for (const double reach : {1.0, 4.0, 8.0}) {
    for (const double strength : {0.0, 0.5, 2.0}) {
      const double r = std::exp(-1 / reach);
      std::vector<double> step, bend;
      for (int k = 0; k < kLength; ++k) {
        step.push_back(k < kMiddle ? 0.25 : 0.75);
        bend.push_back(0.25 + (k < kMiddle ? 0 : 0.001 * (k - kMiddle)));
      }
      const auto seen_step = perceived(step, {strength, reach}), seen_bend = perceived(bend, {strength, reach});
      for (int k = 0; k < 100; ++k) {
        const double off = strength * 0.5 * std::pow(r, k + 1) / (1 + r);
        const auto right = static_cast<std::size_t>(kMiddle + k), left = static_cast<std::size_t>(kMiddle - 1 - k);
        EXPECT_TRUE(near(seen_step[right], 0.75 + off, kAccuracy));
        EXPECT_TRUE(near(seen_step[left], 0.25 - off, kAccuracy));
        // Before the bend the neighbours beyond it are brighter, behind it those before are: darker on both sides.
        const double less = strength * 0.001 * std::pow(r, k + 1) / (1 - r * r);
        EXPECT_TRUE(near(seen_bend[right], bend[right] - less, kAccuracy));
        EXPECT_TRUE(near(seen_bend[left + 1], bend[left + 1] - less, kAccuracy));
      }
    }
  }
}

// CLAIM      IU.3.1.1: the measures of a line are the largest jump of its intensity, of its slope, and of what is perceived.
// ORACLE     closed form: a step, a bend, a slope.
// TOLERANCE  2^-48 (1 + a) as documented, and 4 u for differences of rounded values.
TEST(MachBands, AreMeasured) {
  proves({"IU.3.1.1"}, Oracle::closed_form, "a step, a bend and a slope");
  std::vector<double> step(600, 0.25), bend(600, 0.25), slope(600);
  for (std::size_t k = 0; k < 600; ++k) {
    if (k >= 300) step[k] = 0.75;
    if (k >= 300) bend[k] += 0x1p-10 * static_cast<double>(k - 300);
    slope[k] = 0x1p-10 * static_cast<double>(k);
  }
  const double r = std::exp(-0.25);
  EXPECT_TRUE(near(jumps(step).intensity, 0.5, 0));
  EXPECT_TRUE(near(jumps(step).slope, 0.5, 0));
  EXPECT_TRUE(near(jumps(step).perceived, 0.5 * r / (1 + r), kAccuracy));
  EXPECT_TRUE(near(jumps(bend).intensity, 0x1p-10, 0));
  EXPECT_TRUE(near(jumps(bend).slope, 0x1p-10, 0));
  EXPECT_TRUE(near(jumps(bend).perceived, 0x1p-10 * r / (1 - r * r), kAccuracy));
  EXPECT_TRUE(near(jumps(slope).slope, 0, 0));
  // Beyond its ends the line is level: the bend that this makes is 20 pixels away at least.
  EXPECT_TRUE(within(jumps(slope).perceived, 0x1p-10 * r / (1 - r * r) * std::exp(-5.0) + kAccuracy));
  EXPECT_TRUE(holds(perceived({}).empty()));
  EXPECT_TRUE(refuses([] { return perceived(std::vector<double>{1.0}, {-1, 4}); }));
  EXPECT_TRUE(refuses([] { return perceived(std::vector<double>{1.0}, {1, 0}); }));
  EXPECT_TRUE(refuses([] { return perceived(std::vector<double>{std::nan("")}); }));
}

}  // namespace
}  // namespace etendue::validation
