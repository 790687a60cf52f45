// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "etendue/assembly/surface_model.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// Reads the triangles of an STL file, ASCII or binary; a row a triangle. The order of the vertices says where the front
/// is; where a normal says otherwise a note counts it. The format has no unit.
///
/// Errors    input_output; invalid_input: all that is wrong, one line each with its line (binary: byte) and triangle
[[nodiscard]] Result<SurfaceModel> read_stl(const std::filesystem::path& path);

}  // namespace etendue
