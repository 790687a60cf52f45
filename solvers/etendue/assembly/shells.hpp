// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "etendue/meshing/elements.hpp"

namespace etendue {

/// The polygons of the faces, corners within `slack` of one another made the same: transforms round the corners of each
/// face by themselves.
[[nodiscard]] std::vector<Polygon> welded(const std::vector<Face>& faces, double slack);

/// Faces that hang together along common edges, whatever objects they belong to: each edge, the same corners to the last
/// bit, joins two faces, and where more meet, the two with the narrowest angle behind them.
///
/// Returns   groups of four faces and more whose every edge is joined, each in ascending order: what may be the surface
///           of a solid (Blocker::solid tells)
[[nodiscard]] std::vector<std::vector<std::size_t>> closed_shells(const std::vector<Polygon>& faces);

}  // namespace etendue
