// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/io/scene_node.hpp"

namespace etendue {

/// Reads the "camera" of a scene file (docs/scene-format.md); what is wrong is reported, and what could be read returned.
[[nodiscard]] Camera read_camera(const SceneNode& node);

/// Two counts from 1 to `most`, of an array of two integers; what is none is reported.
[[nodiscard]] std::optional<std::pair<int, int>> read_two(const SceneNode& node, const std::string& what, long most);

struct NamedCamera {
  std::string name;  ///< letters, digits, '-' and '_'; that of the file, where it has no other
  Camera camera;
};

/// The cameras of a JSON file, lengths in units of `metres_per_unit`:
///
///     {"eye": …, "look_at": …, …}                            one camera, as scenes have it; lengths in that unit
///     {"unit": "m", "cameras": {"door": {…}, "desk": {…}}}   several, in the file's order
///     a scene file                                           its camera
///
/// Errors    as read_scene(): all that is wrong, with file, line, column and pointer
[[nodiscard]] Result<std::vector<NamedCamera>> read_cameras(const std::filesystem::path& path, double metres_per_unit);

}  // namespace etendue
