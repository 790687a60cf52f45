// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "etendue/assembly/surface_model.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// Reads View3D's input (docs/form-factors.md): surfaces S, masks M, null surfaces N, obstructions O, subsurfaces and
/// combined surfaces. Rows come out in the order of the file, without null surfaces and without what is combined.
/// Obstructions hide from both sides. encl=1 and emit=1 are not followed, and a note says so.
///
/// Errors    input_output; invalid_input: all that is wrong, one line each with its line and surface
[[nodiscard]] Result<SurfaceModel> read_vs3(const std::filesystem::path& path);

}  // namespace etendue
