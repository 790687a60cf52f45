// SPDX-License-Identifier: Apache-2.0
#include "etendue/image/tone_mapping.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/image/exposure.hpp"

namespace etendue {

double luminance(const Eigen::Array3d& rgb) {
  return 0.2126 * rgb(0) + 0.7152 * rgb(1) + 0.0722 * rgb(2);
}

std::optional<double> log_average_luminance(const Image& image) {
  double sum = 0;
  std::size_t lit = 0;
  for (const auto& pixel : image.pixels) {
    const double value = luminance(pixel);
    if (!(value > 0)) continue;
    sum += std::log(value);
    ++lit;
  }
  if (lit == 0) return std::nullopt;
  return std::exp(sum / static_cast<double>(lit));
}

ToneMapped tone_mapped(const Image& image, const ToneMapping& mapping) {
  require(mapping.exposure > 0 && mapping.key > 0 && mapping.white > 0, "tone_mapped: exposure, key and white above 0");
  ToneMapped result;
  result.scale = mapping.exposure;
  if (mapping.tone != ToneOperator::linear) {
    if (const auto average = log_average_luminance(image)) result.scale *= mapping.key / *average;
  }
  result.picture = exposed(image, result.scale);
  if (mapping.tone != ToneOperator::reinhard) return result;
  const double white_squared = mapping.white * mapping.white;
  for (auto& pixel : result.picture.pixels) {
    const double scaled = luminance(pixel);
    pixel *= (1 + scaled / white_squared) / (1 + scaled);
  }
  return result;
}

}  // namespace etendue
