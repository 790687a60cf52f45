// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/scan_line.hpp"

#include <algorithm>

#include "etendue/core/contract.hpp"
#include "etendue/image/tone_mapping.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

// The drawing's sides, and those of the field in it, in pixels.
constexpr double kWide = 720, kHigh = 360, kLeft = 60, kRight = 700, kTop = 40, kBottom = 310;

struct Field {
  double first, last, low, high;

  std::string at(double column, double value) const {
    const double x = kLeft + (kRight - kLeft) * (column - first) / std::max(last - first, 1.0);
    const double y = kBottom - (kBottom - kTop) * (value - low) / (high - low);
    return rounded(x, 6) + "," + rounded(y, 6);
  }
};

/// A pixel is as wide as it is: the curve has steps.
std::string curve(const Field& field, int first, const std::vector<double>& values, const std::string& colour) {
  std::string points;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double column = first + static_cast<double>(k);
    points += field.at(column, values[k]) + " " + field.at(column + 1, values[k]) + " ";
  }
  if (!points.empty()) points.pop_back();
  return "<polyline fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"1.5\" points=\"" + points + "\"/>\n";
}

std::string words(double x, double y, const std::string& anchor, const std::string& colour, const std::string& text) {
  return "<text x=\"" + rounded(x, 6) + "\" y=\"" + rounded(y, 6) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
         colour + "\">" + text + "</text>\n";
}

}  // namespace

ScanLine scan_line(const Image& image, int row, int first, int last) {
  require(row >= 0 && row < image.rows && first >= 0 && first < last && last <= image.columns,
          "scan_line: a part of a row of the picture");
  ScanLine line{row, first, {}};
  for (int column = first; column < last; ++column) line.intensities.push_back(luminance(image.at(column, row)));
  return line;
}

std::string to_svg(const ScanLine& line, const Inhibition& eye) {
  const std::vector<double> seen = perceived(line.intensities, eye);
  double low = 0, high = 0;
  for (const std::vector<double>* values : {&line.intensities, &seen}) {
    for (const double value : *values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(high > low)) high = low + 1;
  const double last = line.first + static_cast<double>(line.intensities.size());
  const Field field{static_cast<double>(line.first), last, low, high};
  const std::string real = "#1f5fa8", felt = "#b5341f", grey = "#666666";
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + rounded(kWide, 6) + "\" height=\"" +
                    rounded(kHigh, 6) + "\" font-family=\"sans-serif\" font-size=\"13\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  svg += "<polyline fill=\"none\" stroke=\"" + grey + "\" points=\"" + field.at(line.first, high) + " " +
         field.at(line.first, low) + " " + field.at(last, low) + "\"/>\n";
  svg += words(kLeft - 6, kTop + 5, "end", grey, rounded(high, 3)) +
         words(kLeft - 6, kBottom + 5, "end", grey, rounded(low, 3));
  svg += words(kLeft, kBottom + 20, "start", grey, "column " + std::to_string(line.first)) +
         words(kRight, kBottom + 20, "end", grey,
               std::to_string(line.first + static_cast<int>(line.intensities.size()) - 1));
  svg += words(kLeft, 24, "start", real, "real") + words(kLeft + 40, 24, "start", felt, "perceived") +
         words(kRight, 24, "end", grey, "luminance along row " + std::to_string(line.row));
  svg += curve(field, line.first, seen, felt) + curve(field, line.first, line.intensities, real);
  svg += words(
      kWide / 2, kHigh - 10, "middle", grey,
      "lateral inhibition: strength " + rounded(eye.strength, 3) + ", reach " + rounded(eye.reach, 3) + " pixels");
  return svg + "</svg>\n";
}

}  // namespace etendue
