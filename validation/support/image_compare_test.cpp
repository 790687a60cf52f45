// SPDX-License-Identifier: Apache-2.0
#include "support/image_compare.hpp"

#include <cmath>
#include <limits>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Image grey(int columns, int rows, double value) {
  Image image(columns, rows);
  for (auto& pixel : image.pixels) pixel = Eigen::Array3d::Constant(value);
  return image;
}

// CLAIM      The comparison of pictures sees a difference in one channel of one pixel, says where, and refuses what cannot be
//            compared: other sizes, empty pictures, NaN, infinities, a missing file.
// ORACLE     identity: the definitions.
// TOLERANCE  none: each outcome is a yes or a no.
TEST(ImageCompare, SeesEveryDifference) {
  proves({}, Oracle::identity, "planted differences");
  const Image reference = grey(4, 3, 0.5);
  EXPECT_TRUE(compare(reference, reference, 0, 0).agrees());
  for (int channel = 0; channel < 3; ++channel) {
    Image changed = reference;
    changed.at(3, 1)[channel] += 0.01;
    const ImageDifference found = compare(changed, reference, 0.009, 0);
    EXPECT_FALSE(found.agrees());
    EXPECT_EQ(found.pixels_above, 1u);
    EXPECT_EQ(found.column, 3);
    EXPECT_EQ(found.row, 1);
    EXPECT_TRUE(compare(changed, reference, 0.011, 0).agrees());
    EXPECT_TRUE(compare(changed, reference, 0, 0.021).agrees());
    EXPECT_FALSE(compare(changed, reference, 0, 0.019).agrees());
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      changed.at(0, 0)[channel] = bad;
      EXPECT_FALSE(compare(changed, reference, 1e300, 0).agrees());
      EXPECT_FALSE(compare(reference, changed, 1e300, 0).agrees());
      EXPECT_FALSE(compare(changed, changed, 1e300, 0).agrees());
    }
  }
  EXPECT_FALSE(compare(grey(3, 4, 0.5), reference, 1, 1).agrees());
  EXPECT_FALSE(compare(Image(), Image(), 1, 1).agrees());
  const ImageDifference missing = compare_with_file(reference, "no-such-folder/no-such-picture.exr", 1, 1);
  EXPECT_FALSE(missing.agrees());
  EXPECT_NE(missing.message.find("no-such-picture.exr"), std::string::npos);
}

}  // namespace
}  // namespace etendue::validation
