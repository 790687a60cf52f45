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
///     no such e      B_v = mean of the elements around v
///
/// Elements of one plane and one material share the vertices that lie within kTouching of each other. A vertex is inner
/// when each edge that ends in it belongs to two elements. The last rule treats the meshes without inner vertices, of
/// which the text (its figure 58b) gives none: each vertex keeps one value, so the picture is continuous, and nothing
/// is extrapolated. Elements in `covered` have no visible front: they take part in no mean, their corners get their own
/// B.
///
/// Contract  one radiosity an element; `covered` holds indices of elements
/// Accuracy  a radiosity that is linear over a plane is reproduced at every vertex of a parallelogram grid with inner
///           vertices, up to rounding
[[nodiscard]] VertexRadiosities vertex_radiosities(const ElementMesh& mesh, const std::vector<Rgb>& radiosity,
                                                   const std::vector<std::size_t>& covered = {});

}  // namespace etendue
