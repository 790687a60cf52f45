// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Which pixels of its rectangle a view has.
enum class ViewOutline {
  rectangle,
  upper_triangle,  ///< those with column + row ≥ columns − 1; of the ones with equality the upper half, seen at its centroid
};

/// A window at distance one before an eye, divided into square pixels: rows run upwards.
struct PixelView {
  Vec3 eye = Vec3::Zero();                                                ///< [length]
  Vec3 across = Vec3::UnitX(), up = Vec3::UnitY(), gaze = Vec3::UnitZ();  ///< across × up = gaze
  int columns = 0, rows = 0;
  double left = -1, bottom = -1, pixel = 0;  ///< of the window, in units of its distance
  ViewOutline window = ViewOutline::rectangle;

  /// Where in the window pixel (column, row) looks: its centre, or the centroid of a half pixel.
  [[nodiscard]] Vec2 sample(int column, int row) const;
  /// The direction of that, of length one along the gaze.
  [[nodiscard]] Vec3 direction(int column, int row) const;
  [[nodiscard]] bool has(int column, int row) const;
};

inline constexpr std::int32_t kNoItem = -1;

/// A polygon counts as seen edge-on, and shows nothing, when the eye is nearer to its plane than this share of its own
/// distance: pixels in its plane must not be hidden by rounding.
inline constexpr double kEdgeOn = 0x1p-40;

/// Corners count as known up to this many roundings of the largest coordinate. Pixels that close to an edge belong to both
/// sides of it, so that no ray slips through where an edge of one polygon meets a corner of another; of both, the nearer
/// is seen, and only one. Counted: the corner's own rounding 1, its difference to the eye 2, the product with an axis 4,
/// the cross product of two corners 5, its product with the pixel's direction 4.
inline constexpr double kCornerRoundings = 16;

/// For each pixel the nearest of the items that were drawn: a depth buffer that keeps numbers, not colours.
///                                                                                                  @eq IU.6.4
/// A pixel sees a convex polygon when its direction lies in the cone over the polygon, that is on the inner side of the
/// planes through the eye and the edges. No corner is projected: none need lie before the eye, nothing is clipped
/// and nothing is rounded to a grid (the window's border cuts by itself, since no pixel lies beyond).
///
/// Accuracy  every pixel shows what a ray through its sample meets first, unless an edge passes the ray within
///           kCornerRoundings roundings of the largest coordinate, or two items lie that near to each other
/// Order     of items at the same depth the first that was drawn; a back behind a front
/// Source    Olano and Greer 1997 for planes instead of projected edges; Catmull 1974 for the depths
class ItemBuffer {
 public:
  /// Contract: columns, rows and pixel positive, axes right-handed
  explicit ItemBuffer(const PixelView& view);
  /// Empties it for another view; memory that is there is used again. Contract: as above
  void look(const PixelView& view);
  /// Draws a flat convex polygon, front or back. Contract: item ≥ 0, at least three corners, `normal` of length one
  void draw(std::span<const Vec3> corners, const Vec3& normal, std::int32_t item);
  /// Calls visit(column, row) for each pixel that has `item` and whose direction meets the polygon.
  template <class Visit>
  void visit_pixels(std::span<const Vec3> corners, const Vec3& normal, std::int32_t item, const Visit& visit) const {
    for (const auto& [column, row] : covered_with(corners, normal, item)) visit(column, row);
  }

  const PixelView& view() const { return view_; }
  std::int32_t item(int column, int row) const { return items_[index(column, row)]; }
  /// One over the depth along the gaze [1/length]; 0 where nothing was drawn.
  double inverse_depth(int column, int row) const { return inverse_depth_[index(column, row)]; }

 private:
  struct Pixel {
    int column, row;
  };
  template <class Body>
  void cover(std::span<const Vec3> corners, const Vec3& normal, const Body& body) const;
  std::vector<Pixel> covered_with(std::span<const Vec3> corners, const Vec3& normal, std::int32_t item) const;
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(view_.columns) + static_cast<std::size_t>(column);
  }

  PixelView view_;
  std::vector<std::int32_t> items_;
  std::vector<double> inverse_depth_;
};

}  // namespace etendue
