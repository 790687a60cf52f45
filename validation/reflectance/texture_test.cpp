// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/texture.hpp"

#include <algorithm>
#include <cmath>

#include "optics/incidence.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Texels = std::vector<Eigen::Array3d>;

/// What a function of column (from the left) and row (from the top) says, at each texel.
template <class Value>
TexturePyramid image_of(int columns, int rows, const Value& value) {
  Texels texels;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) texels.push_back(value(column, row));
  }
  return {columns, rows, std::move(texels)};
}

double worst(const Eigen::Array3d& a, const Eigen::Array3d& b) {
  return (a - b).abs().maxCoeff();
}

PatternFootprint random_footprint(Directions& random, double longest) {
  PatternFootprint footprint;
  footprint.first = {random.uniform(-longest, longest), random.uniform(-longest, longest)};
  const double narrow = random.uniform(0, 1);
  footprint.second = narrow * Vec2(random.uniform(-longest, longest), random.uniform(-longest, longest));
  return footprint;
}

constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::clamp, Wrap::mirror};

// CLAIM      IU.4-1: a texture far away is seen as its mean: a pixel that covers the image or more, however it lies, wherever, also of images whose
//            sides are no powers of two. A chequered one of single texels, which a look at single points shows as 0 or 1, is its mean as soon as
//            pixels cover two texels.
// ORACLE     identity: the sum over all texels.
// TOLERANCE  kTextureError of the largest texel.
TEST(Texture, AveragesToItsMeanFarAway) {
  proves({"IU.4-1"}, Oracle::identity, "sum over all texels, six sizes");
  Directions random(2701);
  for (const auto& [columns, rows] : {std::pair(1, 1), {64, 64}, {128, 32}, {37, 53}, {5, 3}, {1, 9}}) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    const TexturePyramid image = image_of(columns, rows, [&](int, int) {
      Eigen::Array3d texel;
      for (double& value : texel) value = random.uniform(0, 1);
      sum += texel;
      return texel;
    });
    const Eigen::Array3d mean = sum / (columns * rows);
    EXPECT_TRUE(within(worst(image.mean(), mean), kTextureError)) << columns;
    for (int i = 0; i < 200; ++i) {
      PatternFootprint footprint;  // two directions with at least one image in each
      const double angle = random.uniform(0, 7), size = random.uniform(2, 1e6);
      footprint.first = size * Vec2(std::cos(angle), std::sin(angle));
      footprint.second = size * Vec2(-std::sin(angle), std::cos(angle));
      const double u = random.uniform(-9, 9);
      const Eigen::Array3d seen = filtered(image, {u, random.uniform(-9, 9)}, footprint, {});
      EXPECT_TRUE(within(worst(seen, mean), kTextureError)) << columns << ' ' << rows;
    }
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(within(worst(filtered(image, {0, 0}, {{infinity, 0}, {0, 0}}, {}), mean), kTextureError));
  }
  const TexturePyramid board =
      image_of(256, 256, [](int column, int row) { return Eigen::Array3d::Constant((column + row) % 2); });
  int extremes = 0;
  for (int i = 0; i < 500; ++i) {
    const double u = random.uniform(0, 1);
    const PatternPoint at{u, random.uniform(0, 1)};
    const double angle = random.uniform(0, 7), size = random.uniform(2, 200) / 256;
    const Vec2 first(std::cos(angle), std::sin(angle)), second(-std::sin(angle), std::cos(angle));
    const double seen = filtered(board, at, {size * first, size * second}, {})[0];
    EXPECT_TRUE(near(seen, 0.5, kTextureError));
    const double alias = filtered(board, at, {}, {})[0];
    extremes += std::abs(alias - 0.5) > 0.25;
  }
  EXPECT_GT(extremes, 50);  // which a look without a footprint does not average
}

// CLAIM      IU.4-1: what is linear in the image is linear in the pattern: a ramp has its own value at every place, under pixels of any shape, as long
//            as they stay inside. Where sides are no powers of two, within 1/16 of a texel of the level.
// ORACLE     closed form: a + b u + c v.
// TOLERANCE  kTextureError; for other sizes 1/16 of the slope over a texel of the coarser of the two levels.
TEST(Texture, ReproducesRamps) {
  proves({"IU.4-1"}, Oracle::closed_form, "ramps under 3,000 pixels of any shape");
  Directions random(2702);
  constexpr double a = 0.2, b = 0.5, c = 0.3;
  for (const auto& [columns, rows] : {std::pair(256, 256), {512, 128}, {200, 300}}) {
    const bool halves = (columns & (columns - 1)) == 0 && (rows & (rows - 1)) == 0;
    const double across = columns, down = rows;
    const TexturePyramid ramp = image_of(columns, rows, [&](int column, int row) {
      const double value = a + b * (column + 0.5) / across + c * (1 - (row + 0.5) / down);
      return Eigen::Array3d(value, 1 - value, value / 2);
    });
    for (int i = 0; i < 1000; ++i) {
      const double u = random.uniform(0.4, 0.6);
      const PatternPoint at{u, random.uniform(0.4, 0.6)};
      const PatternFootprint footprint = random_footprint(random, i % 2 == 0 ? 0.05 : 0.005);
      const double expected = a + b * at.u + c * at.v;
      // The narrower of the two vectors is at most as long as the first, √2 · 0.05: levels of 0.15 of the image at most.
      const double tolerance = halves ? kTextureError : 2 * 0.15 * (b + c) / 16;
      EXPECT_TRUE(near(filtered(ramp, at, footprint, {})[0], expected, tolerance)) << columns;
      EXPECT_TRUE(near(filtered(ramp, at, footprint, {})[1], 1 - expected, tolerance));
    }
  }
}

// CLAIM      IU.4-1: an elongated pixel is averaged along its length, not across: stripes along it stay, stripes across it go.
// ORACLE     closed form: stripes two texels wide, seen along and across by a pixel 16 texels long and one wide.
// TOLERANCE  kTextureError; across, the texel in the middle of a stripe is seen as it is.
TEST(Texture, AveragesAlongThePixelOnly) {
  proves({"IU.4-1"}, Oracle::closed_form, "stripes along and across");
  const TexturePyramid stripes =
      image_of(128, 128, [](int column, int) { return Eigen::Array3d::Constant(column / 2 % 2); });
  for (int column = 20; column < 100; ++column) {
    const PatternPoint at{(column + 0.5) / 128, 0.37};
    const Vec2 along_u(16.0 / 128, 0), along_v(0, 16.0 / 128);
    const double stripe = column / 2 % 2;
    EXPECT_TRUE(near(filtered(stripes, at, {along_v, {1.0 / 128, 0}}, {})[0], stripe, kTextureError));
    EXPECT_TRUE(near(filtered(stripes, at, {{0, 1.0 / 128}, along_u}, {})[0], 0.5, kTextureError));
    // Conjugate diameters of the same ellipse in another order and mixed by a rotation of the parameter are the same.
    const double turn = 0.6;
    const Vec2 p = std::cos(turn) * along_v + std::sin(turn) * Vec2(1.0 / 128, 0);
    const Vec2 q = -std::sin(turn) * along_v + std::cos(turn) * Vec2(1.0 / 128, 0);
    EXPECT_TRUE(near(filtered(stripes, at, {p, q}, {})[0], stripe, 256 * kTextureError));
  }
}

// CLAIM      IU.4-1: beyond its edges an image repeats, stops at its edge or is mirrored, and is continuous there; rows are counted from the top, v from
//            the bottom.
// ORACLE     identity: the image at the place that the rule leads to.
// TOLERANCE  kTextureError, with 2^-40 for the rounding of places that are moved by whole numbers, times the image's steepest slope, 4.
TEST(Texture, GoesOnBeyondItsEdges) {
  proves({"IU.4-1"}, Oracle::identity, "repeat, clamp, mirror");
  Directions random(2703);
  const TexturePyramid image = image_of(4, 4, [&](int, int) {
    Eigen::Array3d texel;
    for (double& value : texel) value = random.uniform(0, 1);
    return texel;
  });
  EXPECT_TRUE(near(worst(image.between_texels(0, {0.125, 0.125}, {}), image.texel(0, 0, 3)), 0, 0));
  EXPECT_TRUE(near(worst(image.between_texels(0, {0.875, 0.625}, {}), image.texel(0, 3, 1)), 0, 0));
  constexpr double kTolerance = kTextureError + 4 * 4 * 0x1p-40;
  for (int i = 0; i < 2000; ++i) {
    const double u = random.uniform(0, 1), v = random.uniform(0, 1);
    const int k = random.integer(-5, 5), level = random.integer(0, 2);
    for (const Wrap wrap : kWraps) {
      const Wraps wraps{wrap, wrap};
      const Eigen::Array3d inside = image.between_texels(level, {u, v}, wraps);
      const bool odd = k % 2 != 0;
      const PatternPoint beyond =
          wrap == Wrap::repeat || !odd ? PatternPoint{u + k, v - k} : PatternPoint{k + 1 - u, 1 - k - v};
      if (wrap != Wrap::clamp) {
        EXPECT_TRUE(within(worst(image.between_texels(level, beyond, wraps), inside), kTolerance));
      } else {
        EXPECT_TRUE(within(
            worst(image.between_texels(level, {u + 1, v}, wraps), image.between_texels(level, {1, v}, wraps)), 0));
        EXPECT_TRUE(
            within(worst(image.between_texels(level, {u, -v}, wraps), image.between_texels(level, {u, 0}, wraps)), 0));
      }
      for (const double edge : {0.0, 1.0}) {
        const auto before = image.between_texels(level, {edge - 0x1p-42, v}, wraps);
        EXPECT_TRUE(within(worst(before, image.between_texels(level, {edge + 0x1p-42, v}, wraps)), kTolerance));
      }
    }
  }
  EXPECT_TRUE(refuses([] { return TexturePyramid(2, 2, Texels(3)); }));
  EXPECT_TRUE(refuses([&] { return filtered(image, {std::nan(""), 0}, {}, {}); }));
}

// CLAIM      An image has at least one texel, and as many as columns times rows.
// ORACLE     identity: what breaks the rule, one number each, and what just keeps it.
// TOLERANCE  none: refusals.
TEST(Texture, HasTexels) {
  proves({}, Oracle::identity, "one broken rule each");
  const auto make = [](int columns, int rows, std::size_t texels) {
    const TexturePyramid image(columns, rows, std::vector<Eigen::Array3d>(texels, Eigen::Array3d::Ones()));
  };
  EXPECT_TRUE(refuses([&] { make(0, 1, 0); }));
  EXPECT_TRUE(refuses([&] { make(1, 0, 0); }));
  EXPECT_TRUE(refuses([&] { make(-1, -1, 1); }));
  EXPECT_TRUE(refuses([&] { make(2, 3, 5); }));
  EXPECT_NO_THROW(make(1, 1, 1));
}

}  // namespace
}  // namespace etendue::validation
