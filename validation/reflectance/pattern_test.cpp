// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/reflectance/noise.hpp"
#include "etendue/reflectance/squares.hpp"
#include "optics/incidence.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.4-1, of a procedure in place of a file: squares alternate along both edges, in any position; across the plane nothing
//            changes, so that a point that lies beside the plane by rounding has the colour of the square.
// ORACLE     identity: the parity of two integers.
// TOLERANCE  none: points lie an eighth of a square from its edges at least.
TEST(Pattern, AlternatesSquares) {
  proves({"IU.4-1"}, Oracle::identity, "parity of the square's numbers");
  Checkerboard board;
  board.origin = {0.3, -0.2, 7};
  board.u = Vec3(1, 2, 2) / 3;
  board.v = Vec3(2, 1, -2) / 3;
  board.size = 0.4;
  const Vec3 across = board.u.cross(board.v);
  std::uint64_t wrong = 0, compared = 0;
  for (int i = -5; i <= 5; ++i) {
    for (int j = -5; j <= 5; ++j) {
      for (const double off : {-0.375, 0.0, 0.375}) {
        for (const double height : {-1e-17, 0.0, 0.3, 1e5}) {
          const Vec3 point =
              board.origin + board.size * ((i + 0.5 + off) * board.u + (j + 0.5 - off) * board.v) + height * across;
          const double expected = ((i + j) % 2 + 2) % 2;
          wrong += second_share(board, point) != expected ? 1u : 0u;
          ++compared;
        }
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, compared));
}

// CLAIM      IU.4-1: wood shows rings around its axis, each darkening outwards, that bend along the trunk and around it.
// ORACLE     closed form: (r/a − ⌊r/a⌋)² where both sines are zero; with both one, half a ring farther.
// TOLERANCE  the square's slope, 2, times the roundings of r/a, which is below 16: of the frame, the norm and the quotient.
TEST(Pattern, GrowsRings) {
  proves({"IU.4-1"}, Oracle::closed_form, "squares of fractions of rings");
  Wood wood;
  wood.origin = {1, 2, 3};
  wood.axis = Vec3(2, -1, 2) / 3;
  wood.ring = 0.05;
  const TangentFrame frame = tangent_frame(wood.axis);
  constexpr double kTolerance = 2 * 16 * 64 * kUnitRoundoff;
  const double bent = 16.0 / 7 * wood.ring * std::numbers::pi / 2;  // where the sine along the trunk is one
  const double lobe = std::numbers::pi / 6;                         // where the sine around it is one
  for (double rings = 0.3; rings < 15; rings += 0.4375) {
    const double share = rings - std::floor(rings);
    const double radius = rings * wood.ring;
    EXPECT_TRUE(near(second_share(wood, wood.origin + radius * frame.u), share * share, kTolerance)) << rings;
    const Vec3 out = std::cos(lobe) * frame.u + std::sin(lobe) * frame.v;
    const double farther = rings + 0.5 - std::floor(rings + 0.5);
    const double found = second_share(wood, wood.origin + bent * wood.axis + radius * out);
    EXPECT_TRUE(near(found, farther * farther, kTolerance)) << rings;
  }
}

Vec3 random_point(Directions& random, double within) {
  const double x = random.uniform(-within, within), y = random.uniform(-within, within);
  return {x, y, random.uniform(-within, within)};
}

// CLAIM      IU.4-1: gradient noise is zero on its lattice, within its bound, and has continuous first derivatives: at the faces between cells, as
//            anywhere, they differ on the two sides by no more than the second derivative's bound allows.
// ORACLE     identity: zeros; closed form: the bounds of NOTES.md §8.
// TOLERANCE  none for zeros and bounds; two difference quotients over a step h lie kNoiseCurvature h apart at most, and 2^-50/h of rounding.
TEST(Pattern, IsNoiseWithoutSteps) {
  proves({"IU.4-1"}, Oracle::closed_form, "bounds of value, slope and curvature at 30,000 places");
  Directions random(2711);
  std::uint64_t wrong = 0, compared = 0;
  double largest = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 point = random_point(random, 50);
    const Vec3 corner = point.array().round();
    wrong += gradient_noise(corner, 7) != 0 || gradient_noise(1e17 * point, 7) != 0;
    wrong += !(std::abs(gradient_noise(point, 7)) <= kNoiseBound);
    largest = std::max(largest, std::abs(gradient_noise(point, 7)));
    compared += 2;
    const int axis = random.integer(0, 2);
    constexpr double kStep = 0x1p-14;
    for (const bool on_face : {false, true}) {
      Vec3 at = point;
      if (on_face) at[axis] = corner[axis];
      const Vec3 step = kStep * Vec3::Unit(axis);
      const double here = gradient_noise(at, 7);
      const double before = (here - gradient_noise(at - step, 7)) / kStep;
      const double after = (gradient_noise(at + step, 7) - here) / kStep;
      EXPECT_TRUE(within(std::abs(after - before), kNoiseCurvature * kStep + 0x1p-50 / kStep));
      EXPECT_TRUE(within(std::abs(after), kNoiseSlope));
    }
  }
  EXPECT_TRUE(all_agree(wrong, compared));
  EXPECT_GT(largest, 0.5);  // it is no flat noise
  EXPECT_TRUE(refuses([] { return gradient_noise({0, std::nan(""), 0}, 0); }));
}

/// 1 − f(|x|), of its polynomial.
double weight(double x) {
  const double t = std::abs(x);
  return t < 1 ? 1 - t * t * t * (10 - 15 * t + 6 * t * t) : 0;
}

/// ∫ (x (x + h))^k W(x) W(x + h) dx, by the midpoint rule: W has two continuous derivatives.
double overlap(double h, bool moment) {
  constexpr int kParts = 4000;
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    const double x = -1 + 2 * (i + 0.5) / kParts;
    sum += (moment ? x * (x + h) : 1) * weight(x) * weight(x + h) * 2 / kParts;
  }
  return sum;
}

double covariance(const Vec3& h) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double product = 1;
    for (int other = 0; other < 3; ++other) product *= overlap(h[other], other == axis);
    sum += product;
  }
  return sum / 3;
}

// CLAIM      Gradient noise is almost isotropic, but not quite, as its header says: at the distance 1.2 the covariance along a space diagonal is another than along an axis,
//            by 3.4 % of the variance, nowhere by more; along the three axes it is the same.
// ORACLE     closed form: one-dimensional integrals of the blend.
// TOLERANCE  statistics: five standard errors of the mean of N products (one failure in a million), by their own mean square; seed fixed.
TEST(Pattern, HasTheCovarianceOfItsLattice) {
  proves({"IU.4-1"}, Oracle::statistics, "300,000 pairs of places for each of six distances");
  uses_seed(2712);
  constexpr int kPairs = 300000;
  const Vec3 axis(1.2, 0, 0), diagonal = Vec3::Constant(1.2) / std::sqrt(3.0);
  double largest_error = 0;
  for (const Vec3& way : {Vec3(0, 0, 0), Vec3(0.5, 0, 0), axis, Vec3(0, 0, 1.2), Vec3(0, 0.8, 0.6), diagonal}) {
    Directions random(2712);
    double products = 0, squares = 0;
    for (int i = 0; i < kPairs; ++i) {
      const Vec3 at = random_point(random, 1000);
      const double product = gradient_noise(at, 3) * gradient_noise(at + way, 3);
      products += product;
      squares += product * product;
    }
    const double error = 5 * std::sqrt(squares) / kPairs;
    if (way == axis || way == diagonal) largest_error = std::max(largest_error, error);
    EXPECT_TRUE(near(products / kPairs, covariance(way), error)) << way.transpose();
  }
  const double variance = covariance(Vec3::Zero());
  EXPECT_TRUE(apart(covariance(axis), covariance(diagonal), 2 * largest_error));
  constexpr double kLastDigit = 0.0005;  // half of the constant's
  const auto difference = [&](double way) {
    return (covariance(Vec3(way, 0, 0)) - covariance(Vec3::Constant(way / std::sqrt(3.0)))) / variance;
  };
  EXPECT_TRUE(near(difference(1.2), kNoiseAnisotropy, kLastDigit));
  for (double way = 0.1; way < 2; way += 0.1)
    EXPECT_TRUE(within(difference(way), kNoiseAnisotropy + kLastDigit)) << way;
}

// CLAIM      IU.4-1: marble without turbulence is a pile of layers with a vein at each whole one; turbulence moves it by the noise; clouds are noise around a half.
// ORACLE     closed form: (½ + ½ cos 2πx)⁴; the sum of octaves written out.
// TOLERANCE  the slope of the fourth power of a cosine, 4π, times 64 roundings of a number below 64.
TEST(Pattern, LaysVeinsInMarble) {
  proves({"IU.4-1"}, Oracle::closed_form, "layers and octaves, written out");
  Directions random(2713);
  constexpr double kTolerance = 4 * std::numbers::pi * 64 * 64 * kUnitRoundoff;
  Marble marble;
  marble.origin = {1, -2, 3};
  marble.axis = Vec3(1, 2, -2) / 3;
  marble.size = 0.25;
  marble.turbulence = 0;
  marble.seed = 5;
  const Vec3 shift(5.0 / 17, 11.0 / 17, 7.0 / 17);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from = random_point(random, 20);
    const auto expected = [](double layers) {
      return std::pow(0.5 + 0.5 * std::cos(2 * std::numbers::pi * layers), 4);
    };
    const Vec3 point = marble.origin + marble.size * from;
    marble.turbulence = 0;
    EXPECT_TRUE(near(second_share(marble, point), expected(marble.axis.dot(from)), kTolerance));
    marble.turbulence = 0.5;
    marble.octaves = 2;
    const Vec3 seen = (point - marble.origin) / marble.size;
    const double moved = gradient_noise(seen, 5) + gradient_noise(2 * seen + shift, 6) / 2;
    EXPECT_TRUE(near(second_share(marble, point), expected(marble.axis.dot(seen) + 0.5 * moved), kTolerance));
    const Noise clouds{marble.origin, marble.size, 2, 5};
    EXPECT_TRUE(near(second_share(clouds, point), std::clamp(0.5 + moved, 0.0, 1.0), kTolerance));
  }
}

// CLAIM      IU.4-1: each square has one colour, which all its points share, which repeats with the pattern and comes from seed, column and row alone; colours
//            are uniform and neighbours and channels independent.
// ORACLE     identity: the square's numbers; statistics: mean ½, variance 1/12, no correlation.
// TOLERANCE  none; of n numbers five standard errors: √(1/12n) for the mean, √(1/180n) for the variance, 1/(12 √n) for the covariance.
TEST(Pattern, PaintsSquaresAtRandom) {
  proves({"IU.4-1", "IU.f21"}, Oracle::statistics, "120,000 numbers");
  uses_seed(9);
  const ColourSquares squares{200, 200, 9};
  std::uint64_t wrong = 0, compared = 0;
  double sum = 0, square = 0, product = 0, channels = 0;
  Eigen::Array3d before = Eigen::Array3d::Zero();
  for (int row = 0; row < 200; ++row) {
    for (int column = 0; column < 200; ++column) {
      const auto seen = [&](double x, double y) {
        return colour_of_square(squares, {(column + x) / 200, (row + y) / 200});
      };
      const Eigen::Array3d colour = seen(0.5, 0.5);
      for (const double off : {0.01, 0.99}) {
        wrong += (seen(off, 1 - off) != colour).any() || (seen(off + 600, off - 1000) != colour).any();
        ++compared;
      }
      sum += colour.sum();
      square += (colour - 0.5).square().sum();
      if (column > 0) product += ((colour - 0.5) * (before - 0.5)).sum();
      channels += (colour[0] - 0.5) * (colour[1] - 0.5) + (colour[1] - 0.5) * (colour[2] - 0.5);
      before = colour;
    }
  }
  EXPECT_TRUE(all_agree(wrong, compared));
  const double n = 120000;
  EXPECT_TRUE(near(sum / n, 0.5, 5 / std::sqrt(12 * n)));
  EXPECT_TRUE(near(square / n, 1.0 / 12, 5 / std::sqrt(180 * n)));
  EXPECT_TRUE(near(product / n, 0, 5 / (12 * std::sqrt(n))));
  EXPECT_TRUE(near(channels / n, 0, 5 / (12 * std::sqrt(n))));
  // v = 1, a pole, is the last row's; u = 1 is the first column's again.
  EXPECT_TRUE(holds((colour_of_square(squares, {0.5, 1}) == colour_of_square(squares, {0.5, 0.999})).all()));
  EXPECT_TRUE(holds((colour_of_square(squares, {1, 0.5}) == colour_of_square(squares, {0, 0.5})).all()));
}

}  // namespace
}  // namespace etendue::validation
