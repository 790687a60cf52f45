// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "etendue/form_factor/cubic_tetrahedron.hpp"
#include "etendue/form_factor/hemicube.hpp"
#include "etendue/raster/item_buffer.hpp"

namespace etendue {

/// The body of pixels that is put around a point.
enum class PixelBody {
  hemicube,           ///< N × N on top, four sides of N × N/2: 3 N² pixels
  cubic_tetrahedron,  ///< three triangles with N a leg: 3/2 N (N+1) pixels, of legs half as long again
};

/// Finest and coarsest resolution that is of any use: even, so that no pixel looks along an axis.
inline constexpr int kLeastResolution = 50, kMostResolution = 1000;

/// The views of a body of pixels and the exact form factor of each pixel.                     @eq IU.6.4, IU.6-11
class PixelProjection {
 public:
  /// Errors    ContractViolation unless 2 ≤ resolution ≤ 4096 and even
  PixelProjection(PixelBody body, int resolution);

  /// The views from `eye` about the unit vector `normal`, the body turned by `turn` [rad] about it.
  [[nodiscard]] std::vector<PixelView> views(const Vec3& eye, const Vec3& normal, double turn) const;
  /// Of a pixel of views()[view].
  [[nodiscard]] double delta(std::size_t view, int column, int row) const {
    if (body_ == PixelBody::cubic_tetrahedron) return corner_->at(column, row);
    return view == 0 ? cube_->top(column, row) : cube_->side(column, row);
  }
  /// Of the pixel in the middle: none has more.
  [[nodiscard]] double largest_delta() const { return largest_; }

 private:
  PixelBody body_;
  int resolution_;
  std::optional<HemicubeDeltas> cube_;
  std::optional<CubicTetrahedronDeltas> corner_;
  double largest_ = 0;
};

}  // namespace etendue
