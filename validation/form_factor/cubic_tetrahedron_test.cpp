// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/cubic_tetrahedron.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "etendue/core/rounding.hpp"
#include "oracles/hemicube.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kOrderTolerance = 0.05;

double order(double coarse, double fine) {
  return std::log2(std::abs(coarse / fine));
}

// Sum of the centre rule over all five faces of a hemicube.
double hemicube_sum(int n) {
  const double h = 2.0 / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double x = -1 + (i + 0.5) * h;
    for (int j = 0; j < n; ++j) sum += hemicube_top_delta(x, -1 + (j + 0.5) * h, h * h);
    for (int k = 0; k < n / 2; ++k) sum += 4 * hemicube_side_delta(x, (k + 0.5) * h, h * h);
  }
  return sum;
}

// The same over the three faces of a cubic tetrahedron: half pixels at their centroids.
double tetrahedron_sum(int n) {
  const double h = 3.0 / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = n - 1 - i; j < n; ++j) {
      const bool half = i + j == n - 1;
      const double part = half ? 2.0 / 3 : 0.5;
      sum += 3 * cubic_tetrahedron_delta(-2 + (i + part) * h, -2 + (j + part) * h, half ? h * h / 2 : h * h);
    }
  }
  return sum;
}

// CLAIM      IU.6-11: by the values at the pixels' centres the deltas of a hemicube, and of a cubic tetrahedron, sum to
//            1 − O(h²), h the pixel's edge.
// ORACLE     identity: everything that leaves a patch meets the body (6-6); the observed order.
// TOLERANCE  order 2 ± 0.05 from 64 to 128 and from 128 to 256 pixels an edge.
TEST(CubicTetrahedron, CentreRulesSumToOneWithSecondOrder) {
  proves({"IU.6-11", "IU.6.4"}, Oracle::identity, "closure 6-6, observed order");
  for (const int n : {64, 128}) {
    EXPECT_TRUE(near(order(1 - hemicube_sum(n), 1 - hemicube_sum(2 * n)), 2, kOrderTolerance));
    EXPECT_TRUE(near(order(1 - tetrahedron_sum(n), 1 - tetrahedron_sum(2 * n)), 2, kOrderTolerance));
  }
}

// CLAIM      The exact factors of rectangles of a cubic tetrahedron keep their bound; the centre value tends to them with order 2.
// ORACLE     rigorous integrals in balls (oracles/hemicube.cpp) of the three terms that the linear cosine falls into.
// TOLERANCE  the returned bound, and one rounding of each of the oracle's terms and 3 of their sum.
TEST(CubicTetrahedron, ExactFactorsKeepTheirBound) {
  proves({"IU.6-11"}, Oracle::closed_form, "Arb: outer integral by rigorous quadrature");
  constexpr std::uint64_t kSeed = 4;
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  const auto draw = [&] { return static_cast<double>(random() >> 11) * 3 * 0x1p-53 - 2; };  // in [−2, 1)
  const auto exact = [](const HemicubeRectangle& r, double* size) {
    // x/r⁴ is odd in x: its integral over [a, b] is that over [|a|, |b|].
    const double top = oracle::hemicube_top(r.from_x, r.to_x, r.from_y, r.to_y);
    const double y = oracle::hemicube_side(r.from_x, r.to_x, std::abs(r.from_y), std::abs(r.to_y));
    const double x = oracle::hemicube_side(r.from_y, r.to_y, std::abs(r.from_x), std::abs(r.to_x));
    *size = std::abs(top) + std::abs(x) + std::abs(y);
    return (top + x + y) / std::numbers::sqrt3;
  };
  for (int k = 0; k < 40; ++k) {
    HemicubeRectangle r{draw(), draw(), 0, 0};
    r.from_y = draw();
    r.to_y = draw();
    double size = 0;
    const double truth = exact(r, &size);
    const Bounded factor = cubic_tetrahedron_factor(r);
    EXPECT_TRUE(near(factor.value, truth, factor.bound + gamma_bound(4) * size));
    const Bounded top = hemicube_top_factor(r);
    const Bounded y = hemicube_side_factor({r.from_x, r.to_x, std::abs(r.from_y), std::abs(r.to_y)});
    const Bounded x = hemicube_side_factor({r.from_y, r.to_y, std::abs(r.from_x), std::abs(r.to_x)});
    // No sum of three is known better than its terms and two roundings of it.
    EXPECT_TRUE(holds(factor.bound * std::numbers::sqrt3 >= top.bound + x.bound + y.bound + 2 * kUnitRoundoff * size));
  }
  const auto error = [&](double h) {
    double size = 0;
    return cubic_tetrahedron_delta(0.3, -0.7, h * h) -
           exact({0.3 - h / 2, 0.3 + h / 2, -0.7 - h / 2, -0.7 + h / 2}, &size);
  };
  EXPECT_TRUE(near(order(error(0x1p-4), error(0x1p-5)), 4, kOrderTolerance)) << "of a pixel: h² of h² relative";
}

// CLAIM      IU.6.4: the exact deltas of a cubic tetrahedron sum to one at every resolution, a third on each face.
// ORACLE     identity: closure 6-6; and the three faces are alike.
// TOLERANCE  22 roundings a pixel of terms below one, half pixels by Lambert's sum with 64 roundings of 1/2.
TEST(CubicTetrahedron, DeltasSumToOneAtEveryResolution) {
  proves({"IU.6.4", "IU.6.4.1"}, Oracle::identity, "closure 6-6");
  for (const int n : {2, 4, 10, 50, 128}) {
    const CubicTetrahedronDeltas deltas(n);
    std::set<std::pair<int, int>> orbits;
    double sum = 0;
    std::uint64_t wrong = 0, pixels = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = n - 1 - i; j < n; ++j, ++pixels) {
        sum += deltas.at(i, j);
        wrong += deltas.at(i, j) != deltas.at(j, i) || !(deltas.at(i, j) > 0);
        orbits.insert(std::minmax(i, j));
      }
    }
    EXPECT_TRUE(near(sum, 1.0 / 3, (22.0 * static_cast<double>(pixels) + 64.0 * n) * kUnitRoundoff));
    EXPECT_TRUE(all_agree(wrong, pixels));
    EXPECT_TRUE(holds(deltas.stored() == orbits.size())) << "one for each pair of mirrored pixels";
    // A sixth of the 3/2 N (N+1) pixels of all faces, and half of the N/2 on the axis of symmetry.
    EXPECT_TRUE(near(static_cast<double>(deltas.stored()), n * (n + 1) / 4.0 + n / 4.0, 0));
  }
}

// CLAIM      The table's pixel (i, j) is the integral over that pixel; a pixel on the patch's plane counts its upper half.
// ORACLE     the factor of the rectangle, judged above; for the half pixels a midpoint rule on 400² points above the plane.
// TOLERANCE  bounds of the factor; 1e-4 of the half pixel for the midpoint rule (order 2 but for its border, order 1 times
//            the cosine, which is zero there).
TEST(CubicTetrahedron, TableHoldsTheIntegralOfEachPixel) {
  proves({"IU.6.4", "IU.6.4.1"}, Oracle::program, "the rectangle's factor, and sums of points");
  constexpr int kResolution = 6, kPoints = 400;
  const CubicTetrahedronDeltas deltas(kResolution);
  const double h = 0.5;
  for (int i = 0; i < kResolution; ++i) {
    for (int j = kResolution - 1 - i; j < kResolution; ++j) {
      const double x = -2 + i * h, y = -2 + j * h;
      if (i + j > kResolution - 1) {
        const Bounded factor = cubic_tetrahedron_factor({x, x + h, y, y + h});
        EXPECT_TRUE(near(deltas.at(i, j), factor.value, 2 * factor.bound));
        continue;
      }
      double sum = 0;
      const double step = h / kPoints;
      for (int a = 0; a < kPoints; ++a) {
        for (int b = kPoints - 1 - a; b < kPoints; ++b) {
          const double px = x + (a + 0.5) * step, py = y + (b + 0.5) * step;
          sum += cubic_tetrahedron_delta(px, std::max(py, -1 - px), step * step);
        }
      }
      EXPECT_TRUE(near(deltas.at(i, j), sum, 1e-4 * sum));
    }
  }
}

// CLAIM      What is no cubic tetrahedron is refused.
// ORACLE     identity: one broken rule each.
// TOLERANCE  none.
TEST(CubicTetrahedron, RefusesPixelsBelowThePatch) {
  proves({}, Oracle::identity, "one broken rule each");
  EXPECT_TRUE(refuses([] { static_cast<void>(cubic_tetrahedron_delta(-1, -0.5, 1)); }));
  EXPECT_TRUE(refuses([] { CubicTetrahedronDeltas odd(5); }));
  EXPECT_TRUE(refuses([] { static_cast<void>(CubicTetrahedronDeltas(4).at(1, 1)); }));
}

}  // namespace
}  // namespace etendue::validation
