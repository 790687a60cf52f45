// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "etendue/reflectance/mapping.hpp"

namespace etendue {

/// The six images of the pattern of the surroundings, in the order of kCubeFaces: each size × size colours, row by row from the top,
/// each that of the direction through its centre.
struct CubeImages {
  int size = 1;
  std::array<std::vector<Eigen::Array3d>, 6> pixels;
};

/// The surroundings of an object as it mirrors them: what is seen in a direction from the middle of the cube.  @eq IU.4.1.3
///
/// Between pixels colours are bilinear in the image's u, v. Where images meet, they share the colours along the edge: means of the two
/// pixels beside it, which belong to the places half way between them, and at a corner of three. So the pattern is continuous over the whole
/// sphere of directions, and no seam shows but the text's distortion: cells next to an edge are half as wide, and all cells seem smaller
/// from the middle, the farther from a face's centre: to 1/√8 = 0.354 of the solid angle at an edge, to 1/√27 = 0.192 at a corner.
/// Domain    size ≥ 1, size² finite colours a face
/// Accuracy  of a smooth pattern, O(1/size²) everywhere, edges and corners too; proved: NOTES.md §7, and tested. On both sides
///           of an edge the same within kCubeEdgeError
/// Errors    ContractViolation outside the domain
class CubeMap {
 public:
  explicit CubeMap(const CubeImages& images);

  int size() const { return size_; }

  /// Domain    a finite vector other than zero, of any length
  [[nodiscard]] Eigen::Array3d at(const Vec3& direction) const;

 private:
  struct Face {
    std::vector<Eigen::Array3d> knots;  // (size + 2)², the outer ones on the edges; from the bottom left
  };
  Eigen::Array3d& knot(std::size_t face, int column, int row);
  const Eigen::Array3d& knot(std::size_t face, int column, int row) const;

  int size_;
  std::array<Face, 6> faces_;
};

/// By how much the sides of an edge may differ, of the largest colour: the roundings of three interpolations on each.
inline constexpr double kCubeEdgeError = 0x1p-44;

}  // namespace etendue
