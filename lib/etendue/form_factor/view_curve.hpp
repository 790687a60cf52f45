// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/form_factor/polynomial_roots.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// A piece of an outline as seen from an eye at the origin: a segment, or an arc of a circle of at most 120°. The
/// direction in which its points are seen is P(x) = p_0 + p_1 x + p_2 x²; NOTES.md §13.
class ViewCurve {
 public:
  static ViewCurve segment(const Vec3& from, const Vec3& to);
  /// The points centre + cos t u + sin t v for t from `begin` to `end`, begin < end; u and v normal to one another, and
  /// as long as the radius. Added to `curves` in pieces.
  static void add_arc(const Vec3& centre, const Vec3& u, const Vec3& v, double begin, double end,
                      std::vector<ViewCurve>& curves);

  double begin() const { return begin_; }
  double end() const { return end_; }
  Vec3 direction(double x) const { return p0_ + x * (p1_ + x * p2_); }  ///< not of length one
  Vec3 tangent(double x) const { return p1_ + 2 * x * p2_; }            ///< of direction(x)
  /// Distance of the point that is seen at x.
  double distance(double x) const;

  /// Where the curve may pass through the plane through the eye across `normal`.
  void cut_by_plane(const Vec3& normal, std::vector<double>& cuts) const;
  /// Where it may pass through the cone with d · Q d = 0, Q symmetric.
  void cut_by_cone(const Mat3& quadric, std::vector<double>& cuts) const;

  /// Lambert's integral along the piece from x_a to x_b: its share of the factor of what lies to its left.
  ///
  ///     (1/2π) ∫ n · (p' × p)/|p|² dx                                                    @eq IU.6-2, IU.6-10
  double share(double x_a, double x_b, const Vec3& normal) const;

 private:
  ViewCurve() = default;
  double segment_integral(double x_a, double x_b, const Vec3& normal) const;
  double arc_integral(double x_a, double x_b, const Vec3& normal) const;

  Vec3 p0_, p1_, p2_;
  double begin_ = 0, end_ = 1;
  bool arc_ = false;
  Vec3 centre_, u_, v_;  ///< of an arc, turned so that x = tan(t/2)
};

}  // namespace etendue
