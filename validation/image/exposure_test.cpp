// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/exposure.hpp"

#include <cmath>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/image/tone_mapping.hpp"
#include "etendue/scene/scene.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.2.8, globally: dividing by the largest value of the picture leaves nothing above one and keeps all ratios.
// ORACLE     identity: ratios before and after.
// TOLERANCE  the factor, the two products and the quotients: five roundings.
TEST(Exposure, ScalesAWholePictureToItsBrightest) {
  proves({"IU.2.8"}, Oracle::identity, "ratios of channels before and after");
  Image image(3, 1);
  image.at(0, 0) = {0.3, 0.7, 0.1};
  image.at(1, 0) = {1.7, 0.9, 0.2};
  image.at(2, 0) = {0.2, 1.1, 1.0};
  const Brightness before = brightness(image);
  EXPECT_EQ(before.largest, 1.7);
  EXPECT_EQ(before.overflow, 2u);
  const Image scaled = exposed(image, 1 / before.largest);
  EXPECT_TRUE(near(brightness(scaled).largest, 1, 2 * kUnitRoundoff));
  for (std::size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double ratio = image.pixels[i][k] / image.pixels[0][0];
      EXPECT_TRUE(near(scaled.pixels[i][k] / scaled.pixels[0][0], ratio, ratio * 5 * kUnitRoundoff));
    }
  }
  EXPECT_EQ(brightness(Image()).largest, 0);
}

// exp and log of glibc, sums of a few logarithms below 50 in magnitude, and a handful of products.
constexpr double kFewRoundings = 64 * kUnitRoundoff;

Image row_of(const std::vector<Rgb>& pixels) {
  Image image(static_cast<int>(pixels.size()), 1);
  image.pixels = pixels;
  return image;
}

Image greys(const std::vector<double>& levels) {
  std::vector<Rgb> pixels;
  for (const double level : levels) pixels.push_back(Rgb::Constant(level));
  return row_of(pixels);
}

ToneMapping by(ToneOperator tone, double key = 0.18, double white = HUGE_VAL, double exposure = 1) {
  return {tone, exposure, key, white};
}

// CLAIM      Luminance weighs the primaries by 0.2126, 0.7152 and 0.0722, white as one; the log-average of luminances 2^-3, 2, 2^5
//            is 2, black pixels not counted, and where all is black there is none.
// ORACLE     closed form: the weights of BT.709 and a geometric mean.
// TOLERANCE  kFewRoundings, relative; the sum of the weights: three roundings.
TEST(ToneMapping, WeighsColoursAndAveragesLogarithms) {
  proves({}, Oracle::closed_form, "BT.709 weights, geometric means of powers of two");
  EXPECT_TRUE(near(luminance({1, 0, 0}), 0.2126, 0));
  EXPECT_TRUE(near(luminance({0, 1, 0}), 0.7152, 0));
  EXPECT_TRUE(near(luminance({0, 0, 1}), 0.0722, 0));
  EXPECT_TRUE(near(luminance({1, 1, 1}), 1, 3 * kUnitRoundoff));
  EXPECT_TRUE(near(log_average_luminance(greys({0.125, 0, 2, 32})).value(), 2, 2 * kFewRoundings));
  const Image pure = row_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const double mean = std::cbrt(0.2126 * 0.7152 * 0.0722);
  EXPECT_TRUE(near(log_average_luminance(pure).value(), mean, mean * kFewRoundings));
  EXPECT_TRUE(holds(!log_average_luminance(greys({0, 0})) && !log_average_luminance(Image())));
}

// CLAIM      Linear: every value times the exposure. By key a: times a over the log-average, times the exposure, whatever the
//            picture was multiplied by before. Reinhard: L/(1 + L) of that, with a white point W L (1 + L/W²)/(1 + L), so that W
//            becomes 1 to the last bits and a luminance of one a half; ratios of channels stay. A black picture stays black.
// ORACLE     closed form: Reinhard and others 2002, equations 1 to 4, on greys whose log-average is 2.
// TOLERANCE  kFewRoundings, relative.
TEST(ToneMapping, MapsGreysAsThePaperSays) {
  proves({}, Oracle::closed_form, "equations 1 to 4 on greys of log-average 2");
  const std::vector<double> levels{0.125, 2, 32};
  const auto mapped = [&](double factor, const ToneMapping& how) {
    std::vector<double> scaled;
    for (const double level : levels) scaled.push_back(factor * level);
    return tone_mapped(greys(scaled), how);
  };
  for (const double factor : {1.0, 1e-30, 3.7e12}) {
    const ToneMapped key = mapped(factor, by(ToneOperator::key, 0.5));
    const ToneMapped bright = mapped(factor, by(ToneOperator::key, 0.5, HUGE_VAL, 4));
    const ToneMapped open = mapped(factor, by(ToneOperator::reinhard, 2));
    const ToneMapped white = mapped(factor, by(ToneOperator::reinhard, 2, 32));
    EXPECT_TRUE(near(key.scale * factor, 0.25, 0.25 * kFewRoundings));
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const double l = levels[k];
      for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(near(key.picture.pixels[k](c), l / 4, l * kFewRoundings));
        EXPECT_TRUE(near(bright.picture.pixels[k](c), l, 4 * l * kFewRoundings));
        EXPECT_TRUE(near(open.picture.pixels[k](c), l / (1 + l), kFewRoundings));
        EXPECT_TRUE(near(white.picture.pixels[k](c), l * (1 + l / 1024) / (1 + l), kFewRoundings));
      }
    }
    EXPECT_TRUE(near(white.picture.pixels[2](0), 1, kFewRoundings)) << "32 is white";
  }
  EXPECT_TRUE(near(mapped(1, by(ToneOperator::linear, 0.18, HUGE_VAL, 0.125)).picture.pixels[2](1), 4, 0));

  const Rgb colour(8, 2, 0.5);
  const ToneMapped coloured = tone_mapped(row_of({colour, colour}), by(ToneOperator::reinhard, 3));
  const Rgb expected = colour * (3 / luminance(colour)) / 4;  // both pixels are the average: L = 3, divided by 1 + L
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(near(coloured.picture.pixels[1](c), expected(c), expected(c) * kFewRoundings));
  }
  for (const ToneOperator tone : {ToneOperator::linear, ToneOperator::key, ToneOperator::reinhard}) {
    EXPECT_TRUE(holds((tone_mapped(greys({0, 0}), by(tone)).picture.pixels[1] == 0).all()));
  }
  EXPECT_TRUE(refuses([] { (void)tone_mapped(Image(), by(ToneOperator::key, 0)); }));
  EXPECT_TRUE(refuses([] { (void)tone_mapped(Image(), by(ToneOperator::linear, 0.18, HUGE_VAL, -1)); }));
}

}  // namespace
}  // namespace etendue::validation
