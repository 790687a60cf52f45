// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "etendue/assembly/surface_model.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// Reads the surfaces of a file; its ending says what it is: .json (docs/scene-format.md), .vs3, .obj or .stl
/// (docs/form-factors.md).
///
/// Errors    usage: another ending; input_output: it cannot be read; invalid_input: one line for each error, with file,
///           line and surface
[[nodiscard]] Result<SurfaceModel> read_surfaces(const std::filesystem::path& path);

}  // namespace etendue
