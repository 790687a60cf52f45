// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/sight_zone.hpp"

namespace etendue {

/// Lambert's factors from one point to many polygons past the same blockers: their shadow cones are formed once.
///
///     F = ∫ V cos a_x cos a / (π r²) dA                                                  @eq IU.6-2, IU.6-4, IU.6-10
///
/// Symbols   V one where the point sees the polygon's point, else zero; r distance; a_x, a angles to the two normals [rad]
/// Order     not for several threads at once: it keeps its buffers
class PointView {
 public:
  /// Domain    point finite and inside of no solid, normal of length one within 16 u. The blockers are not needed afterwards
  PointView(const Vec3& point, const Vec3& normal, std::span<const Blocker* const> blockers);

  /// The factor to what of a polygon is above the horizon and behind none of the blockers `hiding`, numbers in the order
  /// in which they were given.
  ///
  /// Symbols   corners: of a convex flat polygon, counter-clockwise as seen from its front
  /// Domain    the point before the polygon's plane by more than rounding; each of these blockers wholly before that
  ///           plane, or on it
  /// Returns   value in [0, 1] and a bound on its absolute error
  /// Accuracy  counted as point_to_polygon() and visible_point_to_polygon(): NOTES.md §1, §5, and §15 for the turned frame
  [[nodiscard]] Bounded factor(std::span<const Vec3> corners, std::span<const std::size_t> hiding);

 private:
  using Part = std::vector<Vec3>;
  /// All directions inside of all planes are hidden.
  struct Cone {
    std::vector<Vec3> corners, planes;
    double turned;  ///< by how much rounding turns its planes, summed [u rad]
  };

  bool misses(const Cone& cone, const Part& part) const;
  bool take(const Cone& cone);
  void split(Part& inside, Part& outside);

  PointFrame frame_;
  std::vector<std::vector<Cone>> cones_;  ///< of each blocker
  std::vector<Part> parts_, kept_;        ///< of which the first `used_` count
  std::size_t used_ = 0;
  std::vector<double> heights_;
  Part buffer_;
};

}  // namespace etendue
