// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/exposure.hpp"

#include "etendue/core/rounding.hpp"
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

}  // namespace
}  // namespace etendue::validation
