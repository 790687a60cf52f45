// SPDX-License-Identifier: Apache-2.0
#include "support/image_compare.hpp"

#include <cmath>
#include <sstream>

#include "etendue/io/image_file.hpp"

namespace etendue::validation {

ImageDifference compare(const Image& actual, const Image& expected, double absolute, double relative) {
  ImageDifference found;
  std::ostringstream text;
  text.precision(17);
  if (actual.pixels.empty() || actual.columns != expected.columns || actual.rows != expected.rows) {
    text << "sizes " << actual.columns << " × " << actual.rows << " and " << expected.columns << " × " << expected.rows;
    found.message = text.str();
    return found;
  }
  found.comparable = true;
  for (int row = 0; row < actual.rows; ++row) {
    for (int column = 0; column < actual.columns; ++column) {
      bool above = false;
      for (int channel = 0; channel < 3; ++channel) {
        const double wanted = expected.at(column, row)[channel];
        const double difference = std::abs(actual.at(column, row)[channel] - wanted);
        if (!std::isfinite(difference)) {
          text << "not a finite number in pixel " << column << ", " << row;
          found.comparable = false;
          found.message = text.str();
          return found;
        }
        above = above || !(difference <= absolute + relative * std::abs(wanted));
        if (difference > found.worst) {
          found.worst = difference;
          found.column = column;
          found.row = row;
        }
      }
      if (above) ++found.pixels_above;
    }
  }
  text << found.pixels_above << " of " << actual.pixels.size() << " pixels differ, at most by " << found.worst
       << " in pixel " << found.column << ", " << found.row;
  found.message = text.str();
  return found;
}

ImageDifference compare_with_file(const Image& actual, const std::filesystem::path& expected, double absolute,
                                  double relative) {
  const auto stored = read_image(expected);
  if (stored) return compare(actual, *stored, absolute, relative);
  ImageDifference missing;
  missing.message = stored.error().message;
  return missing;
}

}  // namespace etendue::validation
