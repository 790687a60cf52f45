// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "etendue/image/image.hpp"

namespace etendue {

/// Exposures that the programs take; zero would make every picture black, beyond no picture is meant.
inline constexpr double kLeastExposure = 1e-12;
inline constexpr double kMostExposure = 1e12;

/// The picture with every value multiplied by `factor`: what a longer or shorter exposure shows. With
/// factor = 1 / brightness(image).largest nothing overflows and all ratios are kept.                @eq IU.2.8
[[nodiscard]] Image exposed(const Image& image, double factor);

/// How bright a picture is, against the largest value that a display shows, 1.
struct Brightness {
  double largest = 0;        ///< largest channel of any pixel; 0 for an empty picture
  std::size_t overflow = 0;  ///< pixels with a channel above 1
};
[[nodiscard]] Brightness brightness(const Image& image);

/// What becomes of values above one where a picture is shown.                                       @eq IU.2.8, IU.2.9
enum class Overflow {
  clamp,        ///< each channel is cut off
  scale_image,  ///< all are divided by the picture's largest value: keeps all ratios
  scale_pixel,  ///< a pixel by its own largest channel: keeps its hue and saturation
};

/// The picture with all values in [0, 1], by lib/etendue/reflectance/overflow.hpp. Negative values, which a filter with negative
/// weights leaves beside edges, become 0 first.
[[nodiscard]] Image limited(const Image& image, Overflow overflow);

}  // namespace etendue
