// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "etendue/image/image.hpp"
#include "etendue/raster/scan.hpp"

namespace etendue {

/// A corner of a triangle on the picture.
struct GouraudVertex {
  Vec2 position;         ///< [pixels], from the top-left corner, rows downwards
  double inverse_depth;  ///< 1/w, w > 0 the distance from the eye along the gaze
  Eigen::Array3d value;  ///< what is interpolated: linear on the surface
};

/// A picture with a depth for each pixel. Triangles are drawn in any order; the nearest one stays, the first of equals.
///
///     v = Σ λ_k v_k/w_k / Σ λ_k/w_k                                                              @eq IU.6.5
///
/// Symbols   λ_k barycentric coordinates of the pixel's centre on the picture; v_k, w_k value and depth of the corners
/// Accuracy  v is the value at the surface point that the centre shows, up to the snapping of the corners by half of
///           1/kSubpixels pixels (measured: validation/raster)
class DepthRaster {
 public:
  DepthRaster(int columns, int rows, const Eigen::Array3d& background);
  void draw(const std::array<GouraudVertex, 3>& triangle);

  const Image& picture() const { return picture_; }
  /// 1/w of what each pixel shows; 0 where nothing was drawn.
  const std::vector<double>& inverse_depth() const { return inverse_depth_; }

 private:
  Image picture_;
  std::vector<double> inverse_depth_;
};

}  // namespace etendue
