// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/rectangles.hpp"

#include <cmath>

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

// CLAIM      The rectangles refuse lengths that are not positive.
// ORACLE     identity: the documented contract.
// TOLERANCE  none: each call throws or does not.
TEST(Rectangles, RefuseLengthsThatAreNotPositive) {
  EXPECT_THROW(static_cast<void>(parallel_rectangles(0, 1, 1)), ContractViolation);
  EXPECT_THROW(static_cast<void>(perpendicular_rectangles(1, -1, 1)), ContractViolation);
}

}  // namespace
}  // namespace etendue::validation
