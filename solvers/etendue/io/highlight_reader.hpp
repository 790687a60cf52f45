// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/io/scene_node.hpp"

namespace etendue {

/// The "highlight" of a material whose "n" is `exponent`. What is wrong is reported.
[[nodiscard]] std::optional<Highlight> read_highlight(const SceneNode& node, double exponent);

}  // namespace etendue
