// SPDX-License-Identifier: Apache-2.0
#include "etendue/core/double_double_functions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "oracles/exact_reals.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20261124;
constexpr int kParts =
    64;  // of [0, 1]: every entry of the tables, which go by thirty-seconds, and every middle between two
constexpr int kEach = 24;  // arguments near each of them

/// A number of the leading digits, and any digits after them.
DoubleDouble continued(double high, CounterRandom& random) {
  return {high, high * (random.unit() - 0.5) * 0x1p-53};
}

// CLAIM      the logarithm in twice the digits errs by at most the documented bound, for every entry of its table, with and
//            without a power of two beside it.
// ORACLE     exact: ln of the exact sum of both parts, balls of 400 bits.
// TOLERANCE  kDoubleDoubleFunctionError, relative, as the header derives it.
TEST(DoubleDoubleFunctions, LogarithmKeepsItsBound) {
  proves({}, Oracle::exact, "Arb's log at 400 bits near every entry of the table");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  double worst = 0;
  for (int part = 0; part <= kParts; ++part) {
    for (int i = 0; i < kEach; ++i) {
      const double m = 0.70 + 0.72 * (part + 0.5 * random.unit()) / kParts;
      const int exponent = i % 3 == 0 ? 0 : static_cast<int>(random.next() % 1900) - 950;
      const DoubleDouble x = continued(std::ldexp(m, exponent), random), result = log(x);
      worst = std::max(worst, oracle::relative_error_of_log({x.high, x.low}, {result.high, result.low}));
    }
  }
  EXPECT_TRUE(within(worst, kDoubleDoubleFunctionError));
  EXPECT_TRUE(holds(log(DoubleDouble(1)).high == 0));
  EXPECT_TRUE(refuses([] { return log(DoubleDouble(0)); }));
}

// CLAIM      the angle of a point of the upper half-plane errs by at most the documented bound: in all four octants, for every
//            entry of the table, at any size.
// ORACLE     exact: atan2 of the exact sums, balls of 400 bits.
// TOLERANCE  kDoubleDoubleFunctionError, absolute, as the header derives it.
TEST(DoubleDoubleFunctions, AngleKeepsItsBound) {
  proves({}, Oracle::exact, "Arb's atan2 at 400 bits near every entry of the table, in four octants");
  uses_seed(kSeed + 1);
  CounterRandom random(kSeed + 1);
  double worst = 0;
  for (int part = 0; part <= kParts; ++part) {
    for (int i = 0; i < kEach; ++i) {
      const double size = std::ldexp(1 + random.unit(), static_cast<int>(random.next() % 800) - 400);
      const double share =
          i == 0 ? static_cast<double>(part) / kParts : std::min(1.0, (part + 0.5 * random.unit()) / kParts);
      const DoubleDouble longer = continued(size, random), shorter = continued(size * share, random);
      const bool steep = (i & 1) != 0;
      const DoubleDouble y = steep ? longer : shorter, across = steep ? shorter : longer,
                         x = (i & 2) != 0 ? -across : across;
      const DoubleDouble result = angle_of(y, x);
      worst = std::max(worst, oracle::error_of_angle({y.high, y.low}, {x.high, x.low}, {result.high, result.low}));
    }
  }
  EXPECT_TRUE(within(worst, kDoubleDoubleFunctionError));
  EXPECT_TRUE(holds(angle_of(0, 0).high == 0));
  EXPECT_TRUE(refuses([] { return angle_of(-0x1p-1000, 1); }));
}

}  // namespace
}  // namespace etendue::validation
