// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Whether `point` lies inside the closed chain of vertices, all projected along the coordinate axis `axis`: the
/// Jordan curve test.                                                                          @eq IU.5.6.2, E16
///
/// The half-line from the point in direction +u crosses an edge iff its ends lie on different sides of the u axis,
/// where a vertex on the axis counts to the +v side. So every crossing is counted once, and a point on the boundary
/// belongs to exactly one of two polygons that share the edge.
///
/// Accuracy  exact for the stored doubles, proved: every decision is an orientation()
/// Source    [IU] 5.6.2, mended (docs/errata.md, E16)
[[nodiscard]] bool encloses(const std::vector<Vec3>& vertices, const Vec3& point, int axis);

}  // namespace etendue
