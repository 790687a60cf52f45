// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/hemicube.hpp"

namespace etendue {

/// The cubic tetrahedron: three faces of a cube's corner about a patch, in place of the hemicube's five. In axes x, y, z
/// along the cube's edges the patch lies at the origin with the normal (1, 1, 1)/√3, and the faces are x = 1, y = 1 and
/// z = 1 as far as they lie above its plane x + y + z = 0: right isosceles triangles with the corners (1, 1), (1, −2),
/// (−2, 1), all three alike.

/// Delta form factor of a small pixel at (x, y) of the face z = 1, by the value at that point:
///
///     ΔF = cos φ_i cos φ_q/(π r²) ΔA = (x + y + 1) ΔA/(√3 π (x² + y² + 1)²),
///     cos φ_i = (x + y + 1)/(√3 r), cos φ_q = 1/r                                            @eq IU.6.4, IU.6-11
///
/// Symbols   x, y the pixel's sample, r its distance from the patch's centre; ΔA the pixel's area; cube of edge one
/// Accuracy  the formula: relative error ≤ γ_16 of the sum of the absolute values of x, y and 1
/// Errors    ContractViolation where x + y + 1 < 0: below the patch's plane
/// Source    Beran-Koehn and Pavicic 1991, derived anew
[[nodiscard]] double cubic_tetrahedron_delta(double x, double y, double area);

/// The exact form factor of a rectangle of a face. The cosine at the patch is linear, so it is a sum of three known integrals:
///
///     F = ∫∫ (x + y + 1) dx dy/(√3 π (x² + y² + 1)²) = ([[T(x, y)]] + [[S(y, x)]] + [[S(x, y)]])/√3
///
/// with T of the hemicube's top and S of its side, which is even in the second argument.       @eq IU.6.4, IU.6-11
///
/// Domain    any finite corners; what lies below the patch's plane counts as negative; oriented
/// Returns   value and a bound on its absolute error: those of the terms, and 6 roundings
[[nodiscard]] Bounded cubic_tetrahedron_factor(const HemicubeRectangle& rectangle);

/// All delta form factors of a cubic tetrahedron, each the exact integral over its pixel. The faces have N pixels along
/// a leg of length 3, so that the patch's plane cuts the outermost ones along their diagonals: of these the upper half
/// counts. One face serves for three, and it is symmetric in x and y: of the N(N+1)/2 pixels of a face those with x ≥ y are
/// stored, N/2 (N/2 + 1): a sixth of all, and half of the diagonal.                                   @eq IU.6.4.1
class CubicTetrahedronDeltas {
 public:
  /// Errors    ContractViolation unless 2 ≤ resolution ≤ 4096 and even
  explicit CubicTetrahedronDeltas(int resolution);

  int resolution() const { return 2 * half_; }
  /// Pixel (i, j), both from 0 at the corner (−2, −2), which itself lies below the plane. Contract: i + j ≥ resolution − 1
  double at(int i, int j) const;
  std::size_t stored() const { return values_.size(); }

 private:
  int half_;
  std::vector<double> values_;  ///< column by column from the middle, j ≤ i
};

}  // namespace etendue
