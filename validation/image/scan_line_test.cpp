// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/scan_line.hpp"

#include "etendue/core/contract.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Image ramp() {
  Image image(6, 2);
  for (int column = 0; column < 6; ++column) image.at(column, 1).setConstant(column * 0.25);
  return image;
}

// CLAIM      IU.f16: a scan line has the luminances of the columns that are asked for, no more and no fewer; others are refused.
// ORACLE     exact: a grey ramp in quarters.
// TOLERANCE  luminance of grey is the grey, but for three roundings: 4 u.
TEST(ScanLine, HasTheColumnsThatAreAskedFor) {
  proves({"IU.3.1.1"}, Oracle::exact, "a grey ramp");
  const ScanLine line = scan_line(ramp(), 1, 2, 5);
  EXPECT_TRUE(holds(line.row == 1 && line.first == 2 && line.intensities.size() == 3));
  for (std::size_t k = 0; k < line.intensities.size(); ++k)
    EXPECT_TRUE(near(line.intensities[k], 0.25 * static_cast<double>(k + 2), 0x1p-50));
  EXPECT_TRUE(refuses([&] { (void)scan_line(ramp(), 1, 3, 3); }));
  EXPECT_TRUE(refuses([&] { (void)scan_line(ramp(), 1, 3, 7); }));
  EXPECT_TRUE(refuses([&] { (void)scan_line(ramp(), 2, 3, 4); }));
  EXPECT_TRUE(refuses([&] { (void)scan_line(ramp(), -1, 3, 4); }));
}

// CLAIM      The drawing scales the curve of the real luminances into its field: the lowest at its lower edge, the highest at its upper one
//            (the perceived ones reach beyond where inhibition is on), a pixel being a step as wide as itself.
// ORACLE     exact: the field is 640 x 270 pixels from (60, 40) on; two pixels 0 and 1, without inhibition.
// TOLERANCE  none: the text.
TEST(ScanLine, IsDrawnToScale) {
  proves({"IU.3.1.1"}, Oracle::exact, "corners of the field, by hand");
  Image image(2, 1);
  image.at(1, 0).setConstant(1);
  const std::string svg = to_svg({0, 0, {0, 1}}, {0, 4});
  EXPECT_TRUE(holds(svg.find("points=\"60,310 380,310 380,40 700,40\"") != std::string::npos)) << svg;
}

}  // namespace
}  // namespace etendue::validation
