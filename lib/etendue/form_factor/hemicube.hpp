// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/core/bounded.hpp"

namespace etendue {

/// A rectangle on a face of the hemicube of edge 2 about a patch, the patch's normal being z: on the top (z = 1) in x
/// and y, on a side in the coordinate along the patch and the height above it. Faces are at distance one.
struct HemicubeRectangle {
  double from_x = 0;
  double to_x = 0;
  double from_y = 0;  ///< on a side: height above the patch, not negative
  double to_y = 0;
};

/// Delta form factor of a small pixel of the top, by the value at its centre:
///
///     ΔF = cos² φ/(π r²) ΔA = ΔA/(π (x² + y² + 1)²),   cos φ = 1/r                       @eq IU.6-11, E22, E23
///
/// Symbols   x, y the pixel's centre, r its distance from the patch's centre; ΔA the pixel's area; edge 2, so no units
/// Accuracy  the formula: relative error ≤ γ_10, counted: r² three roundings, its square 7, π and its product 9, the
///           quotient 10. As an approximation of the pixel's integral it is only of second order in the pixel's size;
///           hemicube_top_factor() is that integral
[[nodiscard]] double hemicube_top_delta(double x, double y, double area);

/// The same on a side, where the two cosines differ:
///
///     ΔF = z ΔA/(π (x² + z² + 1)²),   cos φ_i = z/r, cos φ_q = 1/r                            @eq IU.6-11, E22
///
/// Accuracy  relative error ≤ γ_11
/// Errors    ContractViolation where z < 0: below the patch's plane there is no hemicube
[[nodiscard]] double hemicube_side_delta(double x, double z, double area);

/// The exact form factor of a rectangle of the top, which the sum over its pixels approaches:
///
///     F = ∫∫ dx dy/(π (x² + y² + 1)²) = [[T(x, y)]],
///     T(x, y) = (1/2π) [x/√(1+x²) atan(y/√(1+x²)) + y/√(1+y²) atan(x/√(1+y²))]              @eq IU.6-11, IU.6.4
///
/// Domain    any finite corners, also beyond the face; oriented: swapped ends change the sign
/// Returns   value and a bound on its absolute error, 16 roundings of the four corner terms
/// Accuracy  |value − F| ≤ bound, counted in hemicube.cpp for an atan that errs by at most one ulp (glibc's does)
[[nodiscard]] Bounded hemicube_top_factor(const HemicubeRectangle& rectangle);

/// The exact form factor of a rectangle of a side:
///
///     F = ∫∫ z dx dz/(π (x² + z² + 1)²) = [[S(x, z)]],
///     S(x, z) = −(1/2π) atan(x/√(1+z²))/√(1+z²)                                                @eq IU.6-11, IU.6.4
///
/// Errors    ContractViolation where a height is negative
[[nodiscard]] Bounded hemicube_side_factor(const HemicubeRectangle& rectangle);

/// All delta form factors of a hemicube, each the exact integral over its pixel, so that they sum to one at every
/// resolution. Only the distinct ones are stored:                                                @eq IU.6.4.1, E24
///   of the N × N top the N/2 (N/2 + 1)/2 with y ≤ x in one quadrant: an eighth, and the diagonal's other half;
///   of a side, which is N wide and N/2 high, the (N/2)² on one half: half of it, a quarter of a whole cube face.
class HemicubeDeltas {
 public:
  /// Errors    ContractViolation unless 2 ≤ resolution ≤ 4096 and even
  explicit HemicubeDeltas(int resolution);

  int resolution() const { return 2 * half_; }
  /// Pixel (i, j) of the top, both from 0 at the corner (−1, −1).
  double top(int i, int j) const;
  /// Pixel i along a side from 0 at its left end, k upwards from the patch's plane.
  double side(int i, int k) const;

  std::size_t stored_of_top() const { return top_.size(); }
  std::size_t stored_of_side() const { return side_.size(); }

 private:
  int half_;                  ///< pixels from the middle of a face to its border
  std::vector<double> top_;   ///< column by column, j ≤ i, counted from the middle
  std::vector<double> side_;  ///< row by row
};

}  // namespace etendue
