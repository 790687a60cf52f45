// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/exposure.hpp"

#include <algorithm>

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

}  // namespace etendue
