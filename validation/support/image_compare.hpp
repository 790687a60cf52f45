// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "etendue/image/image.hpp"

namespace etendue::validation {

/// How far two pictures are apart.
struct ImageDifference {
  bool comparable = false;       ///< same size, not empty, every value finite
  double worst = 0;              ///< largest |a − b| of a channel
  int column = 0, row = 0;       ///< where
  std::size_t pixels_above = 0;  ///< pixels with a channel that differs by more than the tolerance
  std::string message;           ///< for a person: what was compared, where it is worst, or why it cannot be compared

  bool agrees() const { return comparable && pixels_above == 0; }
};

/// Compares pixel by pixel; a channel may differ by absolute + relative · |expected|.
[[nodiscard]] ImageDifference compare(const Image& actual, const Image& expected, double absolute, double relative);

/// The same against a stored picture. A missing or unreadable file does not agree; it is never written or skipped.
[[nodiscard]] ImageDifference compare_with_file(const Image& actual, const std::filesystem::path& expected,
                                                double absolute, double relative);

}  // namespace etendue::validation
