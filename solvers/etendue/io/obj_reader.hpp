// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "etendue/assembly/surface_model.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// Reads the polygons of a Wavefront OBJ file: records v and f, names from o and g; a row a face, "name" or "name[3]".
/// A concave face is cut into triangles that make up one row. Normals and texture coordinates are not used: the order
/// of a face's vertices says where its front is. The format has no unit.
///
/// Errors    input_output; invalid_input: all that is wrong, one line each with its line and face
[[nodiscard]] Result<SurfaceModel> read_obj(const std::filesystem::path& path);

}  // namespace etendue
