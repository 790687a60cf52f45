// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/reflectance/mapping.hpp"

namespace etendue {

/// What lies beyond the edges of an image, along one direction.
enum class Wrap {
  repeat,  ///< the image again
  clamp,   ///< the texels at the edge
  mirror,  ///< the image again, every other time reversed
};
struct Wraps {
  Wrap u = Wrap::repeat, v = Wrap::repeat;
};

/// How a pixel lies in the pattern: two edges (∂u, ∂v) of the parallelogram that it covers, or diameters of its ellipse.
struct PatternFootprint {
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
};

/// An image, and itself at half the size, and so on down to one texel.                                       @eq IU.4-1
///
/// Level k + 1 has ⌊n/2⌋ texels where level k has n, at least one; each is the mean of the image over the area that it
/// covers. So all levels have the image's mean, and the last is it.
class TexturePyramid {
 public:
  /// Texels row by row from the top.
  /// Domain    columns, rows ≥ 1; columns · rows finite texels
  TexturePyramid(int columns, int rows, std::vector<Eigen::Array3d> texels);

  int levels() const { return static_cast<int>(levels_.size()); }
  int columns(int level = 0) const { return levels_[static_cast<std::size_t>(level)].columns; }
  int rows(int level = 0) const { return levels_[static_cast<std::size_t>(level)].rows; }
  const Eigen::Array3d& mean() const { return levels_.back().texels.front(); }
  /// Column from the left, row from the top.
  const Eigen::Array3d& texel(int level, int column, int row) const;

  /// Between the centres of four texels of a level; u from the left, v from the bottom edge of the image.
  /// Domain    finite u, v
  [[nodiscard]] Eigen::Array3d between_texels(int level, const PatternPoint& at, const Wraps& wraps) const;

 private:
  struct Level {
    int columns, rows;
    std::vector<Eigen::Array3d> texels;
  };
  static Level halved(const Level& level);
  std::vector<Level> levels_;
};

/// Most places where an elongated pixel is looked up.
inline constexpr int kMostProbes = 16;

/// What a pixel sees of an image.                                                                            @eq IU.4-1
///
///     1/N Σ_k T(at + ((k + ½)/N − ½) a, log₂ w),   w = max(σ₂, σ₁/kMostProbes, 1),   N = ⌈σ₁/w⌉
///
/// Symbols   σ₁ ≥ σ₂ diameters, a the longer axis of the ellipse that the footprint's two vectors are conjugate diameters
///           of, in texels; T between texels and levels, each linear in position, log₂ w between the levels
/// Returns   constant images within kTextureError; where the shorter axis is as long as the image or longer, its mean. Ramps
///           a + b u + c v away from the edges: their value at `at`, within kTextureError where sides are powers of
///           two, else within 1/16 of the difference of two texels of the level besides (NOTES.md §9)
/// Domain    finite u, v. A footprint that is not finite sees the mean; neither vector is longer than the image
/// Source    elliptical pixels by probes along their longer axis: McCormack, Perry, Farkas and Jouppi 1999, Feline,
///           doi 10.1145/311535.311562, with equal weights
[[nodiscard]] Eigen::Array3d filtered(const TexturePyramid& image, const PatternPoint& at,
                                      const PatternFootprint& footprint, const Wraps& wraps);

/// Of the largest texel: roundings of twelve halvings both ways, of interpolation and of the probes' mean; and as much for
/// the rounding of the place, which moves a ramp by 2^-45 of its height. Proved: NOTES.md §9.
inline constexpr double kTextureError = 0x1p-44;

}  // namespace etendue
