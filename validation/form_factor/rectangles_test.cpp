// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/rectangles.hpp"

#include <cmath>
#include <limits>

#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/parallel_plates.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kLeast = 1e-4;
constexpr int kPerDecade = 8;
constexpr int kDecades = 7;  // up to 1e3

double ratio(int step) {
  return kLeast * std::pow(10.0, static_cast<double>(step) / kPerDecade);
}

/// The oracle's double is rounded once.
double bar(const Bounded& f) {
  return f.bound + 0x1p-53 * f.value;
}

// CLAIM      IU.6-3: parallel_rectangles is right for all ratios from 1e-4 to 1e3, where C-11 in double is not.
// ORACLE     closed form: C-11 in balls of 600 bits.
// TOLERANCE  the returned bound, itself below kRectangleError of the value.
TEST(Rectangles, KeepParallelPlatesExactAtAllRatios) {
  proves({"IU.6-3"}, Oracle::closed_form, "C-11 in 600-bit balls, 57 × 15 ratios from 1e-4 to 1e3");
  for (int i = 0; i <= kDecades * kPerDecade; ++i) {
    for (int j = 0; j <= kDecades * 2; ++j) {
      const double x = ratio(i), y = ratio(j * kPerDecade / 2);
      const Bounded f = parallel_rectangles(2 * x, 2 * y, 2);
      EXPECT_TRUE(near(f.value, oracle::parallel_plates(x, y), bar(f))) << x << " " << y;
      EXPECT_TRUE(within(f.bound, kRectangleError * f.value)) << x << " " << y;
    }
  }
}

// CLAIM      IU.6-3: perpendicular_rectangles is right for all ratios from 1e-4 to 1e3.
// ORACLE     closed form: C-14 in balls of 600 bits.
// TOLERANCE  the returned bound, itself below kRectangleError of the value.
TEST(Rectangles, KeepPerpendicularPlatesExactAtAllRatios) {
  proves({"IU.6-3"}, Oracle::closed_form, "C-14 in 600-bit balls, 57 × 15 ratios from 1e-4 to 1e3");
  for (int i = 0; i <= kDecades * kPerDecade; ++i) {
    for (int j = 0; j <= kDecades * 2; ++j) {
      const double w = ratio(i), h = ratio(j * kPerDecade / 2);
      const Bounded f = perpendicular_rectangles(w, h, 1);
      EXPECT_TRUE(near(f.value, oracle::perpendicular_plates(h, w), bar(f))) << w << " " << h;
      EXPECT_TRUE(within(f.bound, kRectangleError * f.value)) << w << " " << h;
    }
  }
}

// CLAIM      IU.6-3: the general polygon routine meets the parallel plates over 57 ratios and keeps its returned bound.
// ORACLE     closed form: C-11 in balls of 600 bits.
// TOLERANCE  the returned bound, itself below 1e-10 of the value as asked.
TEST(FormFactor, MeetsParallelPlatesOverSevenDecades) {
  proves({"IU.6-3"}, Oracle::closed_form, "C-11 in 600-bit balls, 57 square ratios and 8 narrow ones");
  constexpr double kAsked = 1e-10;
  const auto check = [&](double x, double y) {
    const Bounded f = form_factor(rectangle({0, 0, 0}, {x, 0, 0}, {0, y, 0}),
                                  rectangle({0, 0, 1}, {0, y, 0}, {x, 0, 0}), {kAsked, 0});
    EXPECT_TRUE(near(f.value, oracle::parallel_plates(x, y), bar(f))) << x << " " << y;
    EXPECT_TRUE(within(f.bound, kAsked * f.value)) << x << " " << y;
  };
  for (int i = 0; i <= kDecades * kPerDecade; ++i) check(ratio(i), ratio(i));
  for (int i = 0; i < kDecades; ++i) check(ratio(i * kPerDecade), 1);
  check(0.3, 1e-3);
}

// CLAIM      IU.6-3: the general polygon routine meets perpendicular plates that share an edge.
// ORACLE     closed form: C-14 in balls of 600 bits.
// TOLERANCE  the returned bound, itself below 1e-9 of the value as asked.
TEST(FormFactor, MeetsPerpendicularPlatesThatShareAnEdge) {
  proves({"IU.6-3"}, Oracle::closed_form, "C-14 in 600-bit balls, 25 ratios from 1e-2 to 1e2");
  constexpr double kAsked = 1e-9;
  for (double w : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    for (double h : {0.01, 0.1, 1.0, 10.0, 100.0}) {
      const Bounded f = form_factor(rectangle({0, 0, 0}, {w, 0, 0}, {0, 1, 0}),
                                    rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, h}), {kAsked, 0});
      EXPECT_TRUE(near(f.value, oracle::perpendicular_plates(h, w), bar(f))) << w << " " << h;
      EXPECT_TRUE(within(f.bound, kAsked * f.value)) << w << " " << h;
    }
  }
}

// CLAIM      IU.6-3: the rectangles keep their accuracy at the ends of their domain, in ratios and in lengths.
// ORACLE     closed form: C-11 and C-14 in balls of 600 bits.
// TOLERANCE  the returned bound, itself below kRectangleError of the value, and kQuotients for the ratios of lengths
//            that are no powers of two: F moves by at most as much, relatively, as each of the two.
TEST(Rectangles, HoldAtTheEndsOfTheirDomain) {
  proves({"IU.6-3"}, Oracle::closed_form, "ratios 1e-6, 1, 1e6 at lengths of 1, 1e-94 and 1e94");
  constexpr double kQuotients = 4 * 0x1p-53;
  for (double x : {kLeastRatio, 1.0, kGreatestRatio}) {
    for (double y : {kLeastRatio, 1.0, kGreatestRatio}) {
      const double parallel = oracle::parallel_plates(x, y), perpendicular = oracle::perpendicular_plates(y, x);
      for (double unit : {1.0, kShortestLength / kLeastRatio * (1 + 0x1p-40), kLongestLength / kGreatestRatio}) {
        const Bounded p = parallel_rectangles(x * unit, y * unit, unit);
        EXPECT_TRUE(near(p.value, parallel, bar(p) + kQuotients * parallel)) << x << " " << y << " " << unit;
        EXPECT_TRUE(within(p.bound, kRectangleError * p.value)) << x << " " << y << " " << unit;
        const Bounded q = perpendicular_rectangles(x * unit, y * unit, unit);
        EXPECT_TRUE(near(q.value, perpendicular, bar(q) + kQuotients * perpendicular)) << x << " " << y << " " << unit;
        EXPECT_TRUE(within(q.bound, kRectangleError * q.value)) << x << " " << y << " " << unit;
      }
    }
  }
}

// CLAIM      IU.6-3: the rectangles refuse lengths and ratios outside their domain.
// ORACLE     identity: the documented contract.
// TOLERANCE  none: each call is refused or not.
TEST(Rectangles, RefuseWhatIsOutsideTheirDomain) {
  proves({"IU.6-3"}, Oracle::identity, "zero, negative, infinite and NaN lengths, ratios past either end");
  constexpr double kInfinite = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
  const double outside[][3] = {{0, 1, 1},
                               {1, -1, 1},
                               {kInfinite, 1, 1},
                               {1, kNan, 1},
                               {1e160, 1e160, 1},
                               {1, 1, 1e170},
                               {1e-170, 1e-170, 1},
                               {1e-320, 1, 1},
                               {1e-200, 1e-200, 1e200},
                               {1e-101, 1e-101, 1e-101},
                               {0.9e-6, 1, 1},
                               {1, 1.1e6, 1}};
  for (const auto& [width, height, third] : outside) {
    const double w = width, h = height, d = third;
    EXPECT_TRUE(refuses([&] { static_cast<void>(parallel_rectangles(w, h, d)); })) << w << " " << h << " " << d;
    EXPECT_TRUE(refuses([&] { static_cast<void>(perpendicular_rectangles(w, h, d)); })) << w << " " << h << " " << d;
  }
}

}  // namespace
}  // namespace etendue::validation
