// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "etendue/meshing/elements.hpp"

namespace etendue {

/// Sine of the largest angle between the normals of elements that count as one plane.
inline constexpr double kSamePlane = 0x1p-20;

/// How much farther, relatively, an inner vertex may be and still count as equally near: its distance is rounded.
inline constexpr double kEquallyNear = 0x1p-30;

/// Where centroids spread so much less across a row than along it (the square of it), there is no gradient across: it would
/// be the rounding of a row that is not quite straight, carried a thousand times as far.
inline constexpr double kInARow = 0x1p-20;

/// Radiosities at the corners of elements, for display only.
struct VertexRadiosities {
  std::vector<std::vector<Rgb>> corners;  ///< one value a corner of each element, as its polygon counts them
  std::size_t vertices = 0;               ///< distinct ones
  std::size_t clamped = 0;                ///< at how many an extrapolation was negative and set to zero (G13)
  std::size_t without_interior = 0;       ///< at how many there was no inner vertex to extrapolate from
};

/// Carries the radiosities of elements to their vertices.                                         @eq IU.6.5
///
///     inner vertex   B_e = mean of the elements around it
///     others         B_v = 2 mean(elements that touch both v and e) − B_e, e the nearest inner vertex that shares an
///                    element with v; the mean over equally near ones. On a grid: edge B_1 + B_2 − B_e,
///                    corner 2B_1 − B_e
///     no such e      B_v = mean of the elements around v + g · (v − mean of their centroids), where g is the gradient of the
///                    affine function nearest to the radiosities of all elements that share a vertex with them (least
///                    squares, weighted by area; along a row of elements, where g is not determined across it, 0 across)
///
/// Elements of one plane and one material share the vertices that lie within touching_distance() of each other. A vertex is inner
/// when each edge that ends in it belongs to two elements. The last rule treats the meshes without inner vertices, for
/// which the text (its figure 58b) gives none: it needs no distinction of cases, each vertex has one value, so that the
/// picture is continuous, and a single element keeps its own. Where there are contacts, elements that are joined at a vertex
/// only across one have values of their own there, on each side of it; give it T-vertices made corners
/// (with_shared_vertices). Elements in `covered` have no visible front: they take part in no mean, their corners get their own
/// B.
///
/// Contract  one radiosity an element; `covered` holds indices of elements
/// Accuracy  a radiosity that is linear over a plane is reproduced, up to rounding, at every vertex of a parallelogram grid
///           of two or more rows and columns, and at every vertex that has neither inner vertices beside it nor all its elements in a row; of a row, what
///           changes along it
[[nodiscard]] VertexRadiosities vertex_radiosities(const ElementMesh& mesh, const std::vector<Rgb>& radiosity,
                                                   const std::vector<std::size_t>& covered = {});

}  // namespace etendue
