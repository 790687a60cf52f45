// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// The scene with half as many elements along every edge, all patches one: the coarser of two meshes between which results are
/// extrapolated. One element stays one: of what neither reflects nor shades anything, as lights do not, no more is needed.
///
/// Errors    invalid_input, one line for each object of which a number of elements is odd and above 1, or left to an
///           element size; and their count. Also where something reflects and nothing that does has more than one
///           element along an edge: the meshes would be the same, and their difference, 0, no estimate of an error
[[nodiscard]] Result<Scene> with_half_the_elements(Scene scene);

/// Names of the objects that reflect and have a single element along an edge: there both meshes are the same, so that
/// what their elements' size does shows in no difference.
[[nodiscard]] std::vector<std::string> not_halved(const Scene& scene);

}  // namespace etendue
