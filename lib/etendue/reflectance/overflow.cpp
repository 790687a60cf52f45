// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/overflow.hpp"

#include <algorithm>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

void require_intensity(const Eigen::Array3d& rgb) {
  require(rgb.isFinite().all() && (rgb >= 0).all(), "overflow: intensities are finite and not negative");
}

}  // namespace

Eigen::Array3d clamp(const Eigen::Array3d& rgb) {
  require(!rgb.isNaN().any(), "clamp: intensities are numbers");
  return rgb.max(0.0).min(1.0);
}

std::vector<Eigen::Array3d> scale_image(std::span<const Eigen::Array3d> pixels) {
  double greatest = 1;
  for (const Eigen::Array3d& pixel : pixels) {
    require_intensity(pixel);
    greatest = std::max(greatest, pixel.maxCoeff());
  }
  std::vector<Eigen::Array3d> scaled;
  scaled.reserve(pixels.size());
  for (const Eigen::Array3d& pixel : pixels) scaled.emplace_back(pixel / greatest);
  return scaled;
}

Eigen::Array3d scale_pixel(const Eigen::Array3d& rgb) {
  require_intensity(rgb);
  return rgb / std::max(1.0, rgb.maxCoeff());
}

}  // namespace etendue
