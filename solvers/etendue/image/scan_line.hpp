// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/image/image.hpp"
#include "etendue/optics/mach_bands.hpp"

namespace etendue {

/// A part of a row of a picture: luminances of the columns [first, first + intensities.size()).
struct ScanLine {
  int row = 0, first = 0;
  std::vector<double> intensities;
};

/// Contract  0 ≤ row < rows, 0 ≤ first < last ≤ columns
[[nodiscard]] ScanLine scan_line(const Image& image, int row, int first, int last);

/// A drawing of the real and the perceived() intensities along the line, one over the other, as SVG.     @eq IU.3.1.1
[[nodiscard]] std::string to_svg(const ScanLine& line, const Inhibition& eye = {});

}  // namespace etendue
