// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/mesh.hpp"
#include "etendue/geometry/quadric.hpp"

namespace etendue {

/// The surface of a quadric in its box as triangles, wound so that f grows outward.
///
/// The box is cut into cells³ boxes, each of these into six tetrahedra; an edge on which f changes its sign holds one corner,
/// the root itself. Tetrahedra fit each other, so the net is closed but at the box's faces.
/// Domain    cells ≥ 1; finite coefficients
/// Accuracy  corners lie on the surface to rounding; between them the net is off by at most e² κ/2, e the longest edge of a
///           tetrahedron, κ the surface's curvature. A part that is thinner than a cell is lost, as f has one sign at all corners
/// Source    elementary
[[nodiscard]] Mesh quadric_net(const Quadric& quadric, int cells);

}  // namespace etendue
