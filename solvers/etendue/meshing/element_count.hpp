// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "etendue/scene/scene.hpp"

namespace etendue {

/// How many elements mesh_elements() makes of the scene, without making them: to refuse what is too much at once.
///
/// Returns   that number exactly where mesh_elements() succeeds and Scene::align_mesh is not set; some parts fewer where it
///           is; else some number
[[nodiscard]] std::size_t count_elements(const Scene& scene);

}  // namespace etendue
