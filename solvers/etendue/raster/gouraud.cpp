// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/gouraud.hpp"

#include "etendue/core/contract.hpp"

namespace etendue {

DepthRaster::DepthRaster(int columns, int rows, const Eigen::Array3d& background)
    : picture_(columns, rows), inverse_depth_(picture_.pixels.size(), 0.0) {
  for (auto& pixel : picture_.pixels) pixel = background;
}

void DepthRaster::draw(const std::array<GouraudVertex, 3>& triangle) {
  for (const auto& corner : triangle) require(corner.inverse_depth > 0, "draw: corners lie before the eye");
  const auto paint = [&](const Covered& pixel) {
    double inverse_depth = 0;
    Eigen::Array3d weighted = Eigen::Array3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = pixel.weight[k] * triangle[k].inverse_depth;
      inverse_depth += weight;
      weighted += weight * triangle[k].value;
    }
    const auto index = static_cast<std::size_t>(pixel.row) * static_cast<std::size_t>(picture_.columns) +
                       static_cast<std::size_t>(pixel.column);
    if (!(inverse_depth > inverse_depth_[index])) return;
    inverse_depth_[index] = inverse_depth;
    picture_.pixels[index] = weighted / inverse_depth;
  };
  scan({triangle[0].position, triangle[1].position, triangle[2].position}, picture_.columns, picture_.rows, paint);
}

}  // namespace etendue
