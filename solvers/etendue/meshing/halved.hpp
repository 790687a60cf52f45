// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/result.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// The scene with half as many elements along every edge, all patches one: the coarser of two meshes between which results are
/// extrapolated. One element stays one: of what neither reflects nor shades anything, as lights do not, no more is needed.
///
/// Errors    invalid_input, one line for each object of which a number of elements is odd and above 1, or left to an
///           element size; and their count
[[nodiscard]] Result<Scene> with_half_the_elements(Scene scene);

}  // namespace etendue
