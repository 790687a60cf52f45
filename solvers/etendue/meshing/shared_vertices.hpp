// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/meshing/elements.hpp"

namespace etendue {

/// The same elements with every vertex that a side of one passes made a corner of it: where small elements end on the side
/// of a large one (T-vertices), all of them then meet in corners, and a display that interpolates between corners has
/// neither crack nor jump there. Elements of one plane and one material count, as for vertex_radiosities().
///
/// Returns   the mesh with as many elements in the same order; polygons keep their place, area and normal up to rounding,
///           and their corners in order, new ones in between on straight sides
/// Accuracy  a vertex lies on a side when it is within touching_distance() of it
[[nodiscard]] ElementMesh with_shared_vertices(const ElementMesh& mesh);

}  // namespace etendue
