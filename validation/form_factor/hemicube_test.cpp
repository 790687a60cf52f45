// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/hemicube.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "oracles/hemicube.hpp"
#include "support/evidence.hpp"
#include "support/exhibit.hpp"

namespace etendue::validation {
namespace {

// The oracle's value is correctly rounded.
double oracle_rounding(double value) {
  return kUnitRoundoff * std::abs(value);
}
constexpr std::uint64_t kSeed = 20240611;
constexpr int kRandomRectangles = 40;

// CLAIM      IU.6-11, E23: the exact factors of rectangles of top and side keep their returned bound; the top gathers
//            0.554126…, each side 0.111468…
// ORACLE     rigorous integrals in balls (oracles/hemicube.cpp), whole faces, pixels and random rectangles.
// TOLERANCE  the returned bound, and the rounding of the oracle.
TEST(Hemicube, ExactFactorsKeepTheirBound) {
  proves({"IU.6-11", "E23"}, Oracle::closed_form, "Arb: outer integral by rigorous quadrature");
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  const auto draw = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };  // in [−1, 1)
  std::vector<HemicubeRectangle> rectangles = {{-1, 1, -1, 1}, {0, 1, 0, 1}, {0.98, 1, 0.98, 1}, {0, 0.02, 0, 0.02}};
  for (int k = 0; k < kRandomRectangles; ++k) rectangles.push_back({draw(), draw(), draw(), draw()});
  for (HemicubeRectangle r : rectangles) {
    const Bounded top = hemicube_top_factor(r);
    const double top_exact = oracle::hemicube_top(r.from_x, r.to_x, r.from_y, r.to_y);
    EXPECT_TRUE(near(top.value, top_exact, top.bound + oracle_rounding(top_exact)));
    r.from_y = std::abs(r.from_y);
    r.to_y = std::abs(r.to_y);
    const Bounded side = hemicube_side_factor(r);
    const double side_exact = oracle::hemicube_side(r.from_x, r.to_x, r.from_y, r.to_y);
    EXPECT_TRUE(near(side.value, side_exact, side.bound + oracle_rounding(side_exact)));
  }
  EXPECT_TRUE(near(hemicube_top_factor({-1, 1, -1, 1}).value, 0.554126, 1e-6)) << "the digits of the erratum";
  EXPECT_TRUE(near(hemicube_side_factor({-1, 1, 0, 1}).value, 0.111468, 1e-6));
}

// CLAIM      IU.6-11, IU.6.4: over the whole hemicube the delta form factors sum to one, at any resolution.
// ORACLE     identity: everything that leaves a patch meets the hemicube (6-6).
// TOLERANCE  one bound a pixel, taken from the widest pixel at the corner, and the rounding of the sum.
TEST(Hemicube, DeltasSumToOneAtEveryResolution) {
  proves({"IU.6-11", "IU.6.4"}, Oracle::identity, "closure 6-6");
  for (const int n : {2, 4, 10, 50, 128}) {
    const HemicubeDeltas deltas(n);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) sum += deltas.top(i, j);
      for (int k = 0; k < n / 2; ++k) sum += 4 * deltas.side(i, k);
    }
    // A pixel's bound is 16 roundings of its four corner terms, each at most 1/4: 3 n² pixels.
    const double tolerance = 3.0 * n * n * (gamma_bound(16) + gamma_bound(1));
    EXPECT_TRUE(near(sum, 1, tolerance));
  }
}

// CLAIM      IU.6-11: the printed value at a pixel's centre tends to the pixel's integral with the square of its size.
// ORACLE     rigorous integrals in balls; the observed order of convergence.
// TOLERANCE  order 2 ± 0.05: halving the pixel divides the error by 4 up to terms of fourth order.
TEST(Hemicube, CentreValuesConvergeWithSecondOrder) {
  proves({"IU.6-11"}, Oracle::closed_form, "Arb, observed order");
  constexpr double kOrderTolerance = 0.05;
  const auto order = [](double coarse, double fine) { return std::log2(std::abs(coarse / fine)); };
  const auto top_error = [](double h) {
    return hemicube_top_delta(0.3, 0.7, h * h) /
               oracle::hemicube_top(0.3 - h / 2, 0.3 + h / 2, 0.7 - h / 2, 0.7 + h / 2) -
           1;
  };
  const auto side_error = [](double h) {
    return hemicube_side_delta(0.3, 0.7, h * h) /
               oracle::hemicube_side(0.3 - h / 2, 0.3 + h / 2, 0.7 - h / 2, 0.7 + h / 2) -
           1;
  };
  EXPECT_TRUE(near(order(top_error(0x1p-4), top_error(0x1p-5)), 2, kOrderTolerance));
  EXPECT_TRUE(near(order(side_error(0x1p-4), side_error(0x1p-5)), 2, kOrderTolerance));
  Convergence top{"Centre values of pixels of the top", "h, a pixel's side", {}, {}, 2, kOrderTolerance}, side = top;
  side.title = "Centre values of pixels of a side";
  for (const double h : {0x1p-4, 0x1p-5, 0x1p-6, 0x1p-7}) {
    top.sizes.push_back(h);
    top.errors.push_back(std::abs(top_error(h)));
    side.sizes.push_back(h);
    side.errors.push_back(std::abs(side_error(h)));
  }
  exhibit(top);
  exhibit(side);
}

// CLAIM      E22: on a side cos φ_q = 1/r; read as l/r with any l ≠ 1 (the height, the half diagonal) the sides miss 1.
// ORACLE     exact: the cosine of the face's normal and the line to its corner, by vectors.
// TOLERANCE  γ_11 of the formula as its header says, and 4 roundings of the cosines here.
TEST(Hemicube, CosineOnASideIsOneOverTheDistance) {
  proves({"E22", "IU.6-11"}, Oracle::identity, "vectors from the patch to the corner of the face");
  // The face x = 1 seen from the origin at (1, y, z) = (1, 0.5, 0.25): φ_q to the normal (1, 0, 0), φ_i to (0, 0, 1).
  const double y = 0.5;
  const double z = 0.25;
  const double r = std::sqrt(1 + y * y + z * z);
  const double cos_q = 1 / r;
  const double cos_i = z / r;
  const double area = 0x1p-10;
  const double right = cos_i * cos_q * area / (std::numbers::pi * r * r);
  EXPECT_TRUE(near(hemicube_side_delta(y, z, area), right, (gamma_bound(11) + gamma_bound(12)) * right));
  for (const double l : {z, std::sqrt(2.0), r}) {
    EXPECT_TRUE(apart(cos_i * (l / r) * area / (std::numbers::pi * r * r), right, 0.1 * right)) << "l = " << l;
  }
}

// CLAIM      IU.6.4.1, E24: an eighth of the top (and the diagonal) and half of a half-height side are distinct; a
//            quarter of such a side would be too little.
// ORACLE     exact: orbits of integer pixel coordinates under the symmetries of the face, counted by sets.
// TOLERANCE  none: counts and equalities.
TEST(Hemicube, StoresOneFactorForEachOrbitOfItsSymmetry) {
  proves({"IU.6.4.1", "E24"}, Oracle::exact, "orbits counted on integers");
  for (const int n : {2, 4, 10, 50}) {
    const HemicubeDeltas deltas(n);
    std::set<std::pair<int, int>> top_orbits;
    std::set<std::pair<int, int>> side_orbits;
    std::set<double> side_values;
    std::uint64_t wrong = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const int a = std::abs(2 * i + 1 - n);  // twice the distance from the middle, in pixels
        const int b = std::abs(2 * j + 1 - n);
        top_orbits.insert(std::minmax(a, b));
        wrong += deltas.top(i, j) != deltas.top(j, i) || deltas.top(i, j) != deltas.top(n - 1 - i, j);
        if (j >= n / 2) continue;
        side_orbits.insert({a, j});
        side_values.insert(deltas.side(i, j));
        wrong += deltas.side(i, j) != deltas.side(n - 1 - i, j);
      }
    }
    EXPECT_TRUE(all_agree(wrong, static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(n)));
    EXPECT_TRUE(holds(deltas.stored_of_top() == top_orbits.size()));
    EXPECT_TRUE(holds(deltas.stored_of_side() == side_orbits.size()));
    EXPECT_TRUE(holds(side_values.size() == side_orbits.size())) << "no two orbits of a side share a factor";
    const double side_pixels = n * n / 2.0;
    EXPECT_TRUE(near(static_cast<double>(side_orbits.size()), side_pixels / 2, 0)) << "half of the half-height face";
    EXPECT_TRUE(near(static_cast<double>(side_orbits.size()), n * n / 4.0, 0)) << "a quarter of a whole face";
    EXPECT_TRUE(apart(side_pixels / 4, static_cast<double>(side_values.size()), 0))
        << "a quarter of the side, as printed";
    // n²/8 and half the diagonal of one quadrant
    EXPECT_TRUE(near(static_cast<double>(top_orbits.size()), n * n / 8.0 + n / 4.0, 0));
  }
}

// CLAIM      IU.6.4: the table's pixel (i, k) of top and side is the integral over that pixel.
// ORACLE     rigorous integrals in balls.
// TOLERANCE  16 roundings of four corner terms of at most 1/4, and the oracle's rounding.
TEST(Hemicube, TableHoldsTheIntegralOfEachPixel) {
  proves({"IU.6.4", "IU.6.4.1"}, Oracle::closed_form, "Arb: outer integral by rigorous quadrature");
  constexpr int kResolution = 6;
  const HemicubeDeltas deltas(kResolution);
  const auto edge = [](int i) { return -1 + i / 3.0; };
  for (int i = 0; i < kResolution; ++i) {
    for (int j = 0; j < kResolution; ++j) {
      const double tolerance = gamma_bound(16) + 4 * kUnitRoundoff;  // edges at multiples of 1/3 are rounded too
      EXPECT_TRUE(near(deltas.top(i, j), oracle::hemicube_top(edge(i), edge(i + 1), edge(j), edge(j + 1)), tolerance));
      if (j >= kResolution / 2) continue;
      EXPECT_TRUE(
          near(deltas.side(i, j), oracle::hemicube_side(edge(i), edge(i + 1), j / 3.0, (j + 1) / 3.0), tolerance));
    }
  }
}

// CLAIM      IU.6-11: what is no hemicube is refused.
// ORACLE     identity: one broken rule each.
// TOLERANCE  none: refusals.
TEST(Hemicube, RefusesHeightsBelowThePatchAndOddResolutions) {
  proves({"IU.6-11"}, Oracle::identity, "one broken rule each");
  EXPECT_TRUE(refuses([] { static_cast<void>(hemicube_side_delta(0, -0.5, 1)); }));
  EXPECT_TRUE(refuses([] { static_cast<void>(hemicube_side_factor({0, 1, -1, 1})); }));
  EXPECT_TRUE(refuses([] { static_cast<void>(hemicube_top_factor({0, std::nan(""), 0, 1})); }));
  EXPECT_TRUE(refuses([] { HemicubeDeltas odd(5); }));
  EXPECT_TRUE(refuses([] { HemicubeDeltas none(0); }));
  const HemicubeDeltas deltas(4);  // columns and rows 0 to 3, on the sides half as many rows
  for (const int outside : {-1, 4}) {
    EXPECT_TRUE(refuses([&] { static_cast<void>(deltas.top(outside, 0)); }));
    EXPECT_TRUE(refuses([&] { static_cast<void>(deltas.top(0, outside)); }));
    EXPECT_TRUE(refuses([&] { static_cast<void>(deltas.side(outside, 0)); }));
  }
  EXPECT_TRUE(refuses([&] { static_cast<void>(deltas.side(0, -1)); }));
  EXPECT_TRUE(refuses([&] { static_cast<void>(deltas.side(0, 2)); }));
  EXPECT_TRUE(holds(deltas.top(3, 3) > 0 && deltas.top(0, 0) > 0 && deltas.side(3, 1) > 0 && deltas.side(0, 0) > 0));
}

}  // namespace
}  // namespace etendue::validation
