// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/geometry/plane.hpp"

namespace etendue {

/// The part of a flat polygon, convex or concave, that lies in front of `plane` or on it.
///
/// Domain    the polygon as its closed chain of vertices, none twice in a row
/// Returns   the chain of the part, in the same winding; empty where fewer than three corners are left. A concave
///           polygon that falls into several parts comes back as one chain whose parts are joined by edges that run
///           to and fro in the plane: line integrals along the chain do not see them
/// Accuracy  which vertices stay is exact; a new corner lies within 4 u max|v_i| of the true one wherever its
///           edge is cut (proved, NOTES.md §9), and is the same from both sides of an edge that two polygons share
/// Source    Sutherland and Hodgman 1974
[[nodiscard]] std::vector<Vec3> clip(const std::vector<Vec3>& vertices, const Plane& plane);

}  // namespace etendue
