// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/reflectance/mapping.hpp"

namespace etendue {

/// "right", "left", "back", "front", "top", "bottom": what the images of a cube are called, in names of files.
[[nodiscard]] constexpr const char* face_name(CubeFace face) {
  constexpr const char* kNames[] = {"right", "left", "back", "front", "top", "bottom"};
  return kNames[static_cast<std::size_t>(face)];
}

}  // namespace etendue
