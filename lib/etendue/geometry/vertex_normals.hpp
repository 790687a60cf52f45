// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "etendue/geometry/mesh.hpp"

namespace etendue {

/// How much the normal of a polygon counts in the mean at one of its corners. The text's "average of the normals of the
/// polygons" is `equal`, each once: of polygons that were cut into triangles it depends on how they were cut, and so does
/// `area`; `angle` does not.
enum class NormalWeight {
  equal,
  area,   ///< of the triangle
  angle,  ///< of the triangle at the vertex
};

/// The unit normal of each triangle, by its winding; zero where it has no area.
[[nodiscard]] std::vector<Vec3> facet_normals(const Mesh& mesh);

/// A normal for each corner of each triangle: the average, normalised, over the triangles around the vertex that go on
/// smoothly from this one.                                                                         @eq IU.3.2a, IU.3.2.1a
///
///     n = Σ w_i n_i / |Σ w_i n_i|
///
/// Two triangles go on smoothly into each other where they share an edge, wound alike, and their normals differ by
/// crease_angle at most. Around a vertex, triangles that are joined so, also by way of others, share one normal; across a
/// crease every side has its own. At a crease that ends at a vertex all triangles there are joined around its end. Vertices at
/// one place are one: they may be given twice, where an image ends.
///
/// Symbols   n_i normals of the triangles, w_i weights
/// Domain    crease_angle in [0, π] [rad]; π smooths every edge, 0 none but flat ones
/// Returns   by triangle and corner; a facet's own normal where the sum is zero (thin fins), zero where that is
/// Errors    ContractViolation for an angle outside the domain or an index without a vertex
/// Source    equal: Gouraud 1971. angle: Thürmer and Wüthrich 1998, doi 10.1080/10867651.1998.10487487
[[nodiscard]] std::vector<std::array<Vec3, 3>> corner_normals(const Mesh& mesh, NormalWeight weight,
                                                              double crease_angle);

}  // namespace etendue
