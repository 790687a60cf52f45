// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
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

/// How a value goes from pixel to pixel along a scan line.                                      @eq IU.3.2b, IU.3.2c
enum class Stepping {
  direct,               ///< start + i · step at the i-th pixel
  direct_on_multiples,  ///< the same from starts and steps that are rounded to common multiples of a power of two
  incremental,          ///< one addition a pixel, of those: none of them rounds
};

/// Bounds on the error of an interpolated v/w as a share of the largest |v_k/w_k|. Directly: eight roundings of each part of
/// the start, whose weights sum to one, and of each of the step's, whose weights change by one at most; four of the
/// sums. Multiples, which are below 2^-49 of it, add half of one at the start and at every pixel from there on.
inline constexpr double kInterpolationError = 36 * 0x1p-53;
constexpr double stepping_error(int columns) {
  return kInterpolationError + (columns + 1) * 0x1p-50;
}

/// A picture with a depth for each pixel. Triangles are drawn in any order; the nearest one stays, the first of equals.
///
///     v = Σ λ_k v_k/w_k / Σ λ_k/w_k                                                              @eq IU.6.5, IU.3.2b
///
/// Where the corners are equally deep this is the text's I_P = v I_R + (1−v) I_Q between the edges of a scan line.
/// On multiples of a power of two that leave room in 53 bits for all sums along a row no addition rounds, so that IU.3.2c's
/// I_P1 + ΔI Δv is the direct formula to the last bit. By default nothing is rounded to multiples.
///
/// Symbols   λ_k barycentric coordinates of the pixel's centre on the picture; v_k, w_k value and depth of the corners
/// Accuracy  v is the value at the surface point that the centre shows, up to the snapping of the corners by half of
///           1/kSubpixels pixels, and kInterpolationError (on multiples: stepping_error()) of the largest |v_k/w_k|, times w;
///           proved
/// Domain    |v_k/w_k| below 2^1000
class DepthRaster {
 public:
  DepthRaster(int columns, int rows, const Eigen::Array3d& background, Stepping stepping = Stepping::direct);
  void draw(const std::array<GouraudVertex, 3>& triangle);

  const Image& picture() const { return picture_; }
  /// 1/w of what each pixel shows; 0 where nothing was drawn.
  const std::vector<double>& inverse_depth() const { return inverse_depth_; }

 private:
  Stepping stepping_;
  Image picture_;
  std::vector<double> inverse_depth_;
};

inline constexpr std::uint32_t kNoFacet = 0xffffffff;

/// A transparent triangle at a pixel.
struct Fragment {
  std::size_t place;  ///< row by row in the rows that are looked at
  double inverse_depth;
  std::uint32_t facet;
  Eigen::Array3d weights;  ///< barycentric coordinates, as of FacetRaster
};
/// By their place, and at each the farthest first.
void sort_back_to_front(std::vector<Fragment>& fragments);

/// For each pixel of some rows the number of the nearest triangle, its depth, and where in the triangle the pixel's centre
/// lies: what is computed from it is computed once a pixel, whatever was drawn there before.
class FacetRaster {
 public:
  explicit FacetRaster(const ScanWindow& window, Stepping stepping = Stepping::direct) { look(window, stepping); }
  /// Empties it for other rows; memory that is there is used again.
  void look(const ScanWindow& window, Stepping stepping = Stepping::direct);
  /// `value` of the corners are barycentric coordinates in triangle `facet`, of which this is all or a part.
  void draw(const std::array<GouraudVertex, 3>& triangle, std::uint32_t facet);

  /// Adds the triangle at each pixel where it is nearer than what is drawn. It hides nothing.
  void collect(const std::array<GouraudVertex, 3>& triangle, std::uint32_t facet,
               std::vector<Fragment>& fragments) const;

  int columns() const { return window_.columns; }
  std::size_t place(int column, int row) const { return index(column, row); }
  std::uint32_t facet(int column, int row) const { return facet_[index(column, row)]; }
  /// Barycentric coordinates on the surface, corrected for perspective; of no meaning where there is no facet.
  const Eigen::Array3d& weights(int column, int row) const { return weights_[index(column, row)]; }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row - window_.first_row) * static_cast<std::size_t>(window_.columns) +
           static_cast<std::size_t>(column);
  }
  ScanWindow window_;
  Stepping stepping_ = Stepping::direct;
  std::vector<double> inverse_depth_;
  std::vector<Eigen::Array3d> weights_;
  std::vector<std::uint32_t> facet_;
};

}  // namespace etendue
