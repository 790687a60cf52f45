// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/filter.hpp"

#include <array>
#include <cmath>

#include "etendue/core/rounding.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Long = long double;

constexpr std::array kKinds{FilterKind::box, FilterKind::tent, FilterKind::gaussian, FilterKind::mitchell};

/// A picture of one row and `columns` pixels, sampled at N equal steps a pixel across and in the middle down.
template <class Light>
std::vector<double> filtered(const PixelFilter& filter, int columns, int n, Light light) {
  FilterRow row(filter, 0, 0, columns);
  for (int column = 0; column < columns; ++column) {
    for (int k = 0; k < n; ++k) {
      const double x = column + (k + 0.5) / n;
      row.add(column, {x, 0.5, 1, Eigen::Array3d::Constant(light(x))});
    }
  }
  std::vector<double> pixels;
  for (int column = 0; column < columns; ++column) pixels.push_back(FilterRow::resolve({&row}, column, 0)[0]);
  return pixels;
}

// CLAIM      IU.5.8.1: the weights of box, tent and Mitchell, one pixel apart, sum to the same wherever they begin: none of them
//            makes a pattern of the pixels. (The Gaussian's do not; its values are divided by the sum.)
// ORACLE     identity: Σ_k f(x − k) is constant in x.
// TOLERANCE  twenty roundings of numbers up to 4.
TEST(PixelFilter, CoversThePlaneEvenly) {
  proves({"IU.5.8.1"}, Oracle::identity, "partition of unity");
  for (const FilterKind kind : {FilterKind::box, FilterKind::tent, FilterKind::mitchell}) {
    const PixelFilter filter = usual_filter(kind);
    for (double x = 0; x < 1; x += 0x1p-6) {
      double sum = 0;
      for (int k = -3; k <= 4; ++k) sum += filter.weight(x - k);
      EXPECT_TRUE(near(sum, 1, 20 * 4 * kUnitRoundoff)) << x;
    }
  }
}

// CLAIM      IU.5.8.1: a constant picture stays constant, whatever filter and wherever the samples are; also at the picture's edge.
// ORACLE     identity: Σ w c / Σ w = c.
// TOLERANCE  each of at most 500 terms adds a rounding of Σ |w| / Σ w, which is below 2 for Mitchell, 1 for the others.
TEST(PixelFilter, KeepsAConstant) {
  proves({"IU.5.8.1"}, Oracle::identity, "a constant picture");
  CounterRandom random(7);
  uses_seed(7);
  for (const FilterKind kind : kKinds) {
    FilterRow row(usual_filter(kind), 0, 0, 9);
    for (int column = 0; column < 9; ++column) {
      for (int k = 0; k < 25; ++k) {
        const double across = random.unit(), down = random.unit();
        row.add(column, {column + across, down, 1.0 + (k % 3), Eigen::Array3d(0.3, 7, 0)});
      }
    }
    for (int column = 0; column < 9; ++column) {
      const Eigen::Array3d pixel = FilterRow::resolve({&row}, column, 0);
      EXPECT_TRUE(near(pixel[0], 0.3, 0.3 * 2 * 500 * kUnitRoundoff));
      EXPECT_TRUE(near(pixel[1], 7, 7 * 2 * 500 * kUnitRoundoff));
      EXPECT_EQ(pixel[2], 0);
    }
  }
}

// CLAIM      IU.5.8.1: a linear picture, sampled uniformly, comes out with its values at the pixels' centres, away from the edge.
// ORACLE     identity: filters are even, so Σ w (x − centre) = 0.
// TOLERANCE  200 roundings of values up to 16.
TEST(PixelFilter, KeepsARamp) {
  proves({"IU.5.8.1"}, Oracle::identity, "a linear picture");
  for (const FilterKind kind : kKinds) {
    for (const int n : {1, 2, 3, 5}) {
      const auto pixels = filtered(usual_filter(kind), 12, n, [](double x) { return 1 + 1.25 * x; });
      for (int column = 3; column < 9; ++column) {
        EXPECT_TRUE(
            near(pixels[static_cast<std::size_t>(column)], 1 + 1.25 * (column + 0.5), 200 * 16 * kUnitRoundoff));
      }
    }
  }
}

/// ∫ f from −∞ to x over ∫ f, by the antiderivatives.
Long covered(FilterKind kind, Long x) {
  const auto clamped = [](Long v, Long limit) { return std::min(std::max(v, -limit), limit); };
  switch (kind) {
    case FilterKind::box:
      return clamped(x, 0.5L) + 0.5L;
    case FilterKind::tent: {
      const Long y = clamped(x, 1);
      return y < 0 ? (1 + y) * (1 + y) / 2 : 1 - (1 - y) * (1 - y) / 2;
    }
    case FilterKind::gaussian: {  // σ = 1/2, cut at 3σ and lowered by its value there
      const Long y = clamped(x, 1.5L), floor = std::exp(-4.5L), root = std::sqrt(2.0L),
                 scale = std::sqrt(std::acos(-1.0L) / 8);
      const auto integral = [&](Long v) { return scale * std::erf(v * root) - floor * v; };
      return (integral(y) - integral(-1.5L)) / (2 * integral(1.5L));
    }
    case FilterKind::mitchell: {
      const Long y = clamped(x, 2), a = std::abs(y);
      // Of the cubics with B = C = 1/3: (21|x|³ − 36|x|² + 16)/18 and (−7|x|³ + 36|x|² − 60|x| + 32)/18.
      const auto inner = [](Long v) { return (21 * v * v * v * v / 4 - 12 * v * v * v + 16 * v) / 18; };
      const auto outer = [](Long v) { return (-7 * v * v * v * v / 4 + 12 * v * v * v - 30 * v * v + 32 * v) / 18; };
      const Long half = a <= 1 ? inner(a) : inner(1) + outer(a) - outer(1);
      return 0.5L + (y < 0 ? -half : half);
    }
  }
  return 0;
}

// CLAIM      IU.5.8.1: across a straight edge a pixel's value is the integral of the filter up to the edge.
// ORACLE     closed form: antiderivatives of the four filters, in extended precision; the tent's and Mitchell's total is one.
// TOLERANCE  of the sum in place of the integral, N samples a pixel: the edge falls between two of them (f_max/(2N)), elsewhere
//            the midpoint rule errs by (variation of f')/(8 N²), which is at most 12 for these.
TEST(PixelFilter, RespondsToAnEdgeByItsIntegral) {
  proves({"IU.5.8.1"}, Oracle::closed_form, "antiderivatives of the filters");
  constexpr int kColumns = 12, kSteps = 64;
  constexpr double kLargest = 1, kVariation = 12;
  constexpr double kTolerance = kLargest / (2 * kSteps) + kVariation / (8.0 * kSteps * kSteps);
  for (const FilterKind kind : kKinds) {
    for (const double edge : {6.0, 6.2, 6.5, 6.71, 6.95}) {
      const auto pixels = filtered(usual_filter(kind), kColumns, kSteps, [&](double x) { return x < edge ? 1 : 0; });
      for (int column = 3; column < 9; ++column) {
        const double expected = static_cast<double>(covered(kind, static_cast<Long>(edge) - (column + 0.5L)));
        EXPECT_TRUE(near(pixels[static_cast<std::size_t>(column)], expected, kTolerance)) << edge << " " << column;
      }
    }
  }
}

// CLAIM      IU.5.8.1: a pixel has the same bits, whether its samples' rows were made for the whole picture or for a part.
// ORACLE     metamorphic: the whole picture.
// TOLERANCE  none: all bits.
TEST(PixelFilter, HasTheSameBitsInAPart) {
  proves({"IU.5.8.1"}, Oracle::metamorphic, "the whole picture");
  std::uint64_t wrong = 0;
  uses_seed(11);
  for (const FilterKind kind : kKinds) {
    CounterRandom random(11);
    FilterRow whole(usual_filter(kind), 3, 0, 20), part(usual_filter(kind), 3, 8, 11);
    for (int column = 0; column < 20; ++column) {
      for (int k = 0; k < 4; ++k) {
        const double across = random.unit(), down = random.unit();
        const ImageSample sample{column + across, 3 + down, 1, Eigen::Array3d::Constant(random.unit())};
        whole.add(column, sample);
        if (column >= 8 - 2 && column < 11 + 2) part.add(column, sample);
      }
    }
    for (int row = 2; row <= 4 && usual_filter(kind).reach() > 0; ++row) {
      for (int column = 8; column < 11; ++column) {
        if ((FilterRow::resolve({&whole}, column, row) != FilterRow::resolve({&part}, column, row)).any()) ++wrong;
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, 27));
}

// CLAIM      IU.5.8.1: a sample counts by the share of the picture that it stands for, times the filter at its place.
// ORACLE     closed form: Σ w f I / Σ w f with tent weights that are whole in binary.
// TOLERANCE  two roundings of a quotient and a sum.
TEST(PixelFilter, CountsASampleByItsWeight) {
  proves({"IU.5.8.1"}, Oracle::closed_form, "two samples of different shares, by hand");
  FilterRow row(usual_filter(FilterKind::tent), 0, 0, 3);
  row.add(1, {1.5, 0.5, 0.75, Eigen::Array3d::Constant(1)});    // f = 1
  row.add(1, {1.75, 0.25, 0.25, Eigen::Array3d::Constant(5)});  // f = 0.75 · 0.75
  const double expected = (0.75 * 1 + 0.25 * 0.5625 * 5) / (0.75 + 0.25 * 0.5625);
  EXPECT_TRUE(near(FilterRow::resolve({&row}, 1, 0)[0], expected, 4 * kUnitRoundoff * expected));
  EXPECT_TRUE(near(FilterRow::resolve({&row}, 2, 0)[0], 5, 4 * kUnitRoundoff * 5));  // the first is out of reach
}

}  // namespace
}  // namespace etendue::validation
