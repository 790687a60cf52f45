// SPDX-License-Identifier: Apache-2.0
#include "support/flip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Long = long double;
using Picture = std::vector<double>;

constexpr int kColumns = 25, kRows = 21;

template <class Colour>
Picture picture(int columns, int rows, Colour&& colour) {
  Picture made;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      for (const double channel : colour(column, row)) made.push_back(channel);
    }
  }
  return made;
}

Picture filled(double r, double g, double b) {
  return picture(kColumns, kRows, [&](int, int) { return std::vector<double>{r, g, b}; });
}

Picture random_picture(std::uint64_t seed) {
  CounterRandom random(seed);
  return picture(kColumns, kRows, [&](int, int) {
    return std::vector<double>{random.unit(), random.unit(), random.unit()};
  });
}

/// X/X_n, Y, Z/Z_n.
struct Relative {
  Long x, y, z;
};

/// Of green and blue of sRGB: their luminances follow from the primaries' chromaticities, whose light adds up to the paper's white.
struct Primaries {
  Relative green, blue;
};
Primaries primaries() {
  const Long white_x = 0.950428545L, white_z = 1.088900371L;
  struct Primary {
    Long x, y;
    Long across() const { return x / y; }
    Long down() const { return (1 - x - y) / y; }
  };
  const Primary red{0.64L, 0.33L}, green{0.30L, 0.60L}, blue{0.15L, 0.06L};
  // Y_r + Y_g + Y_b = 1, Σ Y x/y = X_n, Σ Y z/y = Z_n: Cramer's rule after the first is subtracted.
  const Long g1 = green.across() - red.across(), b1 = blue.across() - red.across(), w1 = white_x - red.across();
  const Long g2 = green.down() - red.down(), b2 = blue.down() - red.down(), w2 = white_z - red.down();
  const Long of_green = (w1 * b2 - w2 * b1) / (g1 * b2 - g2 * b1), of_blue = (g1 * w2 - g2 * w1) / (g1 * b2 - g2 * b1);
  const auto relative = [&](const Primary& p, Long luminance) {
    return Relative{p.across() * luminance / white_x, luminance, p.down() * luminance / white_z};
  };
  return {relative(green, of_green), relative(blue, of_blue)};
}

/// HyAB after Hunt's adjustment.
Long distance(const Relative& one, const Relative& other) {
  const auto f = [](Long t) { return t > 216.0L / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0L / 29; };
  struct Point {
    Long l, a, b;
  };
  const auto hunted = [&](const Relative& c) {
    const Long l = 116 * f(c.y) - 16;
    return Point{l, 5 * (f(c.x) - f(c.y)) * l, 2 * (f(c.y) - f(c.z)) * l};
  };
  const Point a = hunted(one), b = hunted(other);
  return std::abs(a.l - b.l) + std::hypot(a.a - b.a, a.b - b.b);
}

/// The largest distance that the paper takes.
Long most() {
  return distance(primaries().green, primaries().blue);
}

/// A colour difference below the knee, and above it.
Long from_distance(Long distance) {
  const Long limit = std::pow(most(), 0.7L), power = std::pow(distance, 0.7L);
  return power < 0.4L * limit ? 0.95L / 0.4L * power / limit : 0.95L + 0.05L * (power - 0.4L * limit) / (0.6L * limit);
}

constexpr double kFloat = 0x1p-23;  // the map's rounding, and its double arithmetic below it

// CLAIM      a map of ꟻLIP is 0 for equal pictures, the same for two pictures in either order, and within [0, 1].
// ORACLE     identity: of a measure of difference.
// TOLERANCE  none.
TEST(Flip, IsADifference) {
  proves({}, Oracle::identity, "equal, exchanged, limits");
  uses_seed(31);
  const Picture one = random_picture(31), other = random_picture(32);
  const auto same = flip(one, one, kColumns, kRows);
  EXPECT_TRUE(
      all_agree(static_cast<std::uint64_t>(std::count_if(same.begin(), same.end(), [](float f) { return f != 0; })),
                same.size()));
  const auto there = flip(one, other, kColumns, kRows);
  EXPECT_TRUE(holds(there == flip(other, one, kColumns, kRows)));
  const auto outside = [](float f) { return !(f > 0 && f <= 1); };
  EXPECT_TRUE(all_agree(static_cast<std::uint64_t>(std::count_if(there.begin(), there.end(), outside)), there.size()));
}

// CLAIM      pictures of one colour each differ by that colour's distance alone: greys of luminance 1/8 and 27/64 by
//            |116/2 − 116 · 3/4| = 29, black and white by 100, green and blue by the most there is, which is 1.
// ORACLE     closed form: cube roots of these luminances, HyAB after Hunt, and the paper's two lines, in long double.
// TOLERANCE  a float's rounding; the white's coordinates are known to nine decimals.
TEST(Flip, OfConstantColoursIsTheirDistance) {
  proves({}, Oracle::closed_form, "HyAB of greys and primaries, by hand");
  const auto expect_all = [](const Picture& a, const Picture& b, Long expected) {
    for (const float f : flip(a, b, kColumns, kRows))
      ASSERT_TRUE(near(static_cast<double>(f), static_cast<double>(expected), kFloat));
  };
  expect_all(filled(0.125, 0.125, 0.125), filled(27.0 / 64, 27.0 / 64, 27.0 / 64), from_distance(29));
  expect_all(filled(0, 0, 0), filled(1, 1, 1), from_distance(100));
  expect_all(filled(0, 1, 0), filled(0, 0, 1), 1);
  expect_all(filled(-3, std::nan(""), 0), filled(7, 1, INFINITY), from_distance(100));
}

// CLAIM      beside a step from black to white in one of two pictures, the other being black, the edge answers 1 on both sides,
//            and the colour is that of the grey that the eye's filter leaves: ꟻLIP is the difference's power 1 − 2^(−1/4).
// ORACLE     closed form: the filter across the step, one sum over a half line; the sum of positive weights of a derivative is 1.
// TOLERANCE  a float's rounding, eight of them for the chain of a power of a small power.
TEST(Flip, OfAStepAnswersToTheEdge) {
  proves({}, Oracle::closed_form, "a Gaussian's half sum; an edge of height one");
  constexpr int kWide = 60, kStep = 30;
  const Picture step =
      picture(kWide, kRows, [](int column, int) { return std::vector<double>(3, column >= kStep ? 1.0 : 0.0); });
  const Picture black = picture(kWide, kRows, [](int, int) { return std::vector<double>(3, 0.0); });
  const auto map = flip(step, black, kWide, kRows);
  const Long ppd = 0.7L * 3840 / 0.7L * std::numbers::pi_v<Long> / 180, pi = std::numbers::pi_v<Long>;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04L / (2 * pi * pi)) * ppd));
  Long right = 0, all = 0;
  for (int x = -radius; x <= radius; ++x) {
    const Long weight = std::exp(-pi * pi * x * x / (ppd * ppd) / 0.0047L);
    all += weight;
    if (x >= 1) right += weight;  // the last black column sees white from its right neighbour on
  }
  const Long dark = right / all, light = 1 - dark, exponent = 1 - std::pow(2.0L, -0.25L);
  const auto grey = [&](Long y) { return std::pow(from_distance(116 * std::cbrt(y) - 16), exponent); };
  for (int row = 0; row < kRows; ++row) {
    const auto at = [&](int column) {
      return static_cast<double>(map[static_cast<std::size_t>(row * kWide + column)]);
    };
    EXPECT_TRUE(near(at(kStep - 1), static_cast<double>(grey(dark)), 8 * kFloat));
    EXPECT_TRUE(near(at(kStep), static_cast<double>(grey(light)), 8 * kFloat));
    EXPECT_TRUE(near(at(0), 0, 0));
  }
}

constexpr Long kPi = std::numbers::pi_v<Long>, kDegree = 3840 * kPi / 180;  // pixels

/// What one pixel weighs at its own place in the eye's filter, a·√(π/b) exp(−π²d²/b) and one more such term.
Long own_weight(Long a1, Long b1, Long a2, Long b2) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04L / (2 * kPi * kPi)) * kDegree));
  const auto sum = [&](Long b) {
    Long across = 0;
    for (int x = -radius; x <= radius; ++x) across += std::exp(-kPi * kPi * x * x / (kDegree * kDegree) / b);
    return across * across;
  };
  const Long one = a1 * std::sqrt(kPi / b1), other = a2 * std::sqrt(kPi / b2);
  return (one + other) / (one * sum(b1) + other * sum(b2));
}

/// The point filter's answer to one pixel at its own place, which the edge filter does not see: the middle of a second derivative,
/// whose negative weights sum to 1, in both directions.
Long point_answer() {
  const Long sigma = 0.041L * kDegree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  Long inside = 0, along = 0;
  for (int x = -radius; x <= radius; ++x) {
    const Long weight = std::exp(-x * x / (2 * sigma * sigma));
    inside += std::max<Long>(0, 1 - x * x / (sigma * sigma)) * weight;
    along += weight;
  }
  return std::numbers::sqrt2_v<Long> / (inside * along);
}

// CLAIM      where one pixel differs, ꟻLIP there is that of the colour that the eye's filters leave of it, channel by channel, to the
//            power 1 − √(p/√2), p being the change of luminance times the point filter's answer: white on black, blue on grey.
// ORACLE     closed form: the filters' middle weights, as products of sums along a line.
// TOLERANCE  a float's rounding, eight of them; the white's coordinates are known to nine decimals.
TEST(Flip, OfOnePixelAnswersToThePoint) {
  proves({}, Oracle::closed_form, "middle weights of the filters");
  constexpr int kSide = 41, kMiddle = 20;
  const auto dotted = [](double ground, const std::vector<double>& dot) {
    return picture(kSide, kSide, [&](int column, int row) {
      return column == kMiddle && row == kMiddle ? dot : std::vector<double>(3, ground);
    });
  };
  const auto middle = [&](double ground, const std::vector<double>& dot) {
    const auto map = flip(dotted(ground, {ground, ground, ground}), dotted(ground, dot), kSide, kSide);
    return static_cast<double>(map[kMiddle * kSide + kMiddle]);
  };
  const Long of_y = own_weight(1, 0.0047L, 0, 1), of_x = own_weight(1, 0.0053L, 0, 1),
             of_z = own_weight(34.1L, 0.04L, 13.5L, 0.025L);
  const auto expected = [&](Long ground, const Relative& change) {
    const Long y = ground + of_y * change.y;
    const Relative left{y + of_x * (change.x - change.y), y, y - of_z * (change.y - change.z)};
    const Long colour = from_distance(distance({ground, ground, ground}, left));
    const Long power = 1 - std::sqrt(change.y * point_answer() / std::numbers::sqrt2_v<Long>);
    return static_cast<double>(std::pow(colour, power));
  };
  EXPECT_TRUE(near(middle(0, {1, 1, 1}), expected(0, {1, 1, 1}), 8 * kFloat));
  const Relative blue = primaries().blue;
  EXPECT_TRUE(near(middle(0.5, {0.5, 0.5, 1}), expected(0.5L, {blue.x / 2, blue.y / 2, blue.z / 2}), 8 * kFloat));
}

// CLAIM      ꟻLIP knows no direction: turned pictures have the turned map.
// ORACLE     metamorphic: columns and rows exchanged.
// TOLERANCE  a float's rounding: sums run in another order.
TEST(Flip, KnowsNoDirection) {
  proves({}, Oracle::metamorphic, "columns and rows exchanged");
  const auto turned = [](const auto& values, std::size_t channels) {
    auto made = values;
    for (std::size_t r = 0; r < kRows; ++r) {
      for (std::size_t c = 0; c < kColumns; ++c) {
        for (std::size_t k = 0; k < channels; ++k)
          made[(c * kRows + r) * channels + k] = values[(r * kColumns + c) * channels + k];
      }
    }
    return made;
  };
  const Picture one = random_picture(41), other = random_picture(42);
  const auto expected = turned(flip(one, other, kColumns, kRows), 1);
  const auto found = flip(turned(one, 3), turned(other, 3), kRows, kColumns);
  for (std::size_t k = 0; k < found.size(); ++k)
    ASSERT_TRUE(near(static_cast<double>(found[k]), static_cast<double>(expected[k]), 2 * kFloat));
}

}  // namespace
}  // namespace etendue::validation
