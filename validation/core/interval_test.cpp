// SPDX-License-Identifier: Apache-2.0
#include "etendue/core/interval.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "oracles/exact_reals.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20261122;
constexpr double kLargest = std::numeric_limits<double>::max();

class Operands {
 public:
  explicit Operands(std::uint64_t seed) : random_(seed) {}

  std::uint64_t bits() { return random_.next(); }

  /// Eight families: any finite bits, subnormals, near the overflow, of order one (three times), small whole numbers,
  /// few bits; either sign.
  double number() {
    const std::uint64_t z = bits();
    const double sign = (z & 8u) != 0 ? -1 : 1;
    const std::uint64_t fraction = bits() >> 12;
    switch (z & 7u) {
      case 0: {
        const double any = std::bit_cast<double>(bits());
        return std::isfinite(any) ? any : sign;
      }
      case 1:
        return sign * std::bit_cast<double>(fraction);
      case 2:
        return sign * kLargest * (0.5 + 0.5 * static_cast<double>(fraction) * 0x1p-52);
      case 3:
        return sign * static_cast<double>(fraction & 7u);
      case 4:
        return sign * std::ldexp(static_cast<double>(fraction & 255u), static_cast<int>(z >> 32 & 63u) - 32);
      default:
        return sign * std::ldexp(1 + static_cast<double>(fraction) * 0x1p-52, static_cast<int>(z >> 32 & 7u) - 4);
    }
  }

  /// A point, an ulp, a relative width of 1e-9, or any two numbers.
  Interval interval() {
    const double a = number();
    switch (bits() & 3u) {
      case 0:
        return a;
      case 1:
        return {a, std::nextafter(a, kLargest)};
      case 2: {
        const double b = a + 1e-9 * std::abs(a);
        return {a, std::isfinite(b) ? b : a};
      }
      default: {
        const double b = number();
        return {std::min(a, b), std::max(a, b)};
      }
    }
  }

  /// A member: an end, or something between.
  double member(const Interval& a) {
    switch (bits() & 3u) {
      case 0:
        return a.lower;
      case 1:
        return a.upper;
      default:
        return a.middle();
    }
  }

 private:
  CounterRandom random_;
};

/// Counts the bounds that are on the wrong side of the exact result.
struct Tally {
  std::uint64_t wrong = 0, decisions = 0;

  template <class Compare>
  void include(const Interval& claimed, Compare compare) {
    wrong += compare(claimed.lower) < 0 || compare(claimed.upper) > 0 || !(claimed.lower <= claimed.upper);
    ++decisions;
  }
};

// CLAIM      +, −, ·, / and sqrt of intervals hold the exact result of every choice from their operands.
// ORACLE     exact: dyadic numbers of any length; no division, no root.
// TOLERANCE  none: 1.5 million decisions, subnormal, huge, point and wide operands.
TEST(Interval, HoldsTheExactResultOfArithmetic) {
  proves({}, Oracle::exact, "exact dyadic arithmetic (arf), 1.5 million operands of all sizes");
  uses_seed(kSeed);
  Operands random(kSeed);
  Tally sum, difference, product, quotient, root, power;
  constexpr int kRounds = 250000;
  for (int i = 0; i < kRounds; ++i) {
    const Interval a = random.interval(), b = random.interval();
    const double x = random.member(a), y = random.member(b);
    sum.include(a + b, [&](double bound) { return oracle::compare_sum(x, y, bound); });
    difference.include(a - b, [&](double bound) { return oracle::compare_sum(x, -y, bound); });
    product.include(a * b, [&](double bound) { return oracle::compare_product(x, y, bound); });
    if (y != 0) quotient.include(a / b, [&](double bound) { return oracle::compare_quotient(x, y, bound); });
    if (x >= 0) root.include(sqrt(a), [&](double bound) { return oracle::compare_root(x, bound); });
    power.include(square(a), [&](double bound) { return oracle::compare_product(x, x, bound); });
  }
  for (const Tally& tally : {sum, difference, product, quotient, root, power}) {
    EXPECT_TRUE(all_agree(tally.wrong, tally.decisions));
  }
}

// CLAIM      log, atan and angle hold the exact value for every choice from their operands.
// ORACLE     exact: balls of 200 bits.
// TOLERANCE  none.
TEST(Interval, HoldsLogarithmsAndAngles) {
  proves({}, Oracle::exact, "Arb's log, atan, atan2 at 200 bits, 120 000 operands of all sizes");
  uses_seed(kSeed + 1);
  Operands random(kSeed + 1);
  Tally logarithm, turn, corner;
  constexpr int kRounds = 40000;
  for (int i = 0; i < kRounds; ++i) {
    const Interval a = random.interval(), b = random.interval();
    const double x = random.member(a), y = random.member(b);
    if (x > 0) logarithm.include(log(a), [&](double bound) { return oracle::compare_log(x, bound); });
    turn.include(atan(a), [&](double bound) { return oracle::compare_atan(x, bound); });
    if (y >= 0 && (x != 0 || y != 0)) {
      corner.include(angle(b, a), [&](double bound) { return oracle::compare_angle(y, x, bound); });
    }
  }
  for (const Tally& tally : {logarithm, turn, corner}) EXPECT_TRUE(all_agree(tally.wrong, tally.decisions));
  EXPECT_TRUE(holds(oracle::compare_pi(pi().lower) > 0 && oracle::compare_pi(pi().upper) < 0));
}

// CLAIM      the bounds are sharp: the width of a function of one double is what its header says.
// ORACLE     identity: the documented width.
// TOLERANCE  4 u of the result for + − · / sqrt (two steps of at most two units each), 2 (kElementaryError + 4) u for log and atan;
//            an angle is a right or straight one less an atan of at most π/2: 24 u more for the quotient, π and the difference.
TEST(Interval, StaysNarrow) {
  proves({}, Oracle::identity, "documented widths at points of order one");
  uses_seed(kSeed + 2);
  Operands random(kSeed + 2);
  constexpr double kBasic = 8 * kUnitRoundoff, kFunction = 2 * (kElementaryError + 4) * kUnitRoundoff;
  for (int i = 0; i < 20000; ++i) {
    const double x = 1 + static_cast<double>(random.bits() >> 12) * 0x1p-50, y = 0.3 + x * x;
    const auto relative = [](const Interval& a) { return a.width() / a.magnitude(); };
    for (const Interval& a : {Interval(x) + y, Interval(x) - y, Interval(x) * y, Interval(x) / y, sqrt(Interval(x))}) {
      ASSERT_TRUE(within(relative(a), kBasic));
    }
    ASSERT_TRUE(within(relative(atan(Interval(1 / x))), kFunction));
    ASSERT_TRUE(within(log(Interval(1 + x)).width(), kFunction * std::log(1 + x)));
    for (const double across : {y, -y, 1 / y, -1 / y}) {
      ASSERT_TRUE(within(angle(x, across).width(), 2 * kFunction + 24 * kUnitRoundoff));
    }
  }
}

// CLAIM      the nodes and weights of every Gauss rule lie within one unit in the last place of the table.
// ORACLE     exact: Arb's roots of Legendre polynomials at 200 bits; all 528 nodes and weights, so the test is a proof.
// TOLERANCE  none.
TEST(GaussLegendre, IsEnclosedByTheNeighboursOfItsTable) {
  proves({}, Oracle::exact, "all nodes and weights up to 32 points against Arb");
  std::uint64_t wrong = 0, decisions = 0;
  for (int n = 1; n <= kMaxGaussNodes; ++n) {
    for (const QuadratureNode& node : gauss_legendre(n)) {
      // Arb counts from the largest node down.
      int found = 0;
      for (int k = 0; k < n; ++k) {
        found += oracle::legendre_node_within(n, k, below(node.x), above(node.x)) &&
                 oracle::legendre_weight_within(n, k, below(node.weight), above(node.weight));
      }
      wrong += found != 1;
      ++decisions;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decisions));
  EXPECT_TRUE(refuses([] { return gauss_legendre(0); }));
  EXPECT_TRUE(refuses([] { return gauss_legendre(kMaxGaussNodes + 1); }));
}

}  // namespace
}  // namespace etendue::validation
