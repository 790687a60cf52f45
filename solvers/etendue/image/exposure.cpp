// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/exposure.hpp"

#include <algorithm>

#include "etendue/reflectance/overflow.hpp"

namespace etendue {

Image exposed(const Image& image, double factor) {
  Image result = image;
  for (auto& pixel : result.pixels) pixel *= factor;
  return result;
}

Brightness brightness(const Image& image) {
  Brightness found;
  for (const auto& pixel : image.pixels) {
    found.largest = std::max(found.largest, pixel.maxCoeff());
    if (pixel.maxCoeff() > 1) ++found.overflow;
  }
  return found;
}

Image limited(const Image& image, Overflow overflow) {
  Image result = image;
  for (auto& pixel : result.pixels) {
    pixel = pixel.max(0.0);
    if (overflow == Overflow::clamp) pixel = clamp(pixel);
    if (overflow == Overflow::scale_pixel) pixel = scale_pixel(pixel);
  }
  if (overflow == Overflow::scale_image) result.pixels = scale_image(result.pixels);
  return result;
}

}  // namespace etendue
