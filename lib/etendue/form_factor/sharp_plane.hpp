// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/geometry/double_double3.hpp"

namespace etendue {

/// The plane through a polygon's first vertex across its Newell sum, in twice the digits of double: says on which side
/// a point lies even where the unit normal, rounded to double, cannot.
///
/// Domain    vertices of a polygon of size order one or less; not all on a line
/// Accuracy  height() errs by at most error(), its sign is exact: NOTES.md §7
class SharpPlane {
 public:
  explicit SharpPlane(const std::vector<Vec3>& vertices);

  /// Signed distance of `point`, positive in front.
  double height(const Vec3& point) const { return wide_height(point).high; }
  DoubleDouble wide_height(const Vec3& point) const;
  double error(const Vec3& point) const;
  /// The same from the exact Newell sum: right to 2^-100 of itself, but for a factor common to all points.
  DoubleDouble exact_height(const Vec3& point) const;
  Vec3 normal() const { return {normal_.x.high, normal_.y.high, normal_.z.high}; }
  /// Within a few u of itself.
  double area() const { return 0.5 / shrink_; }
  /// Largest distance of a vertex from the plane; 0 where the polygon is exactly flat.
  double flatness() const { return flatness_; }

  friend double least_sine(const SharpPlane& a, const SharpPlane& b);

 private:
  std::vector<Vec3> vertices_;
  DoubleDouble3 normal_;     ///< of length one within a few u
  double normal_error_ = 0;  ///< bound on what its components miss
  double shrink_ = 0;        ///< one over twice the area
  double flatness_ = 0;
};

/// A lower bound on the sine of the angle between two planes.
[[nodiscard]] double least_sine(const SharpPlane& a, const SharpPlane& b);

}  // namespace etendue
