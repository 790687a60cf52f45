// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "etendue/io/scene_reader.hpp"
#include "support/temporary_folder.hpp"

// What the tests of scene files share.
namespace etendue::validation {

/// A sound scene around these objects (and further top-level keys, each followed by a comma).
inline std::string scene_of(const std::string& objects, const std::string& more = "", const std::string& unit = "m") {
  return R"({"format": "etendue-scene", "version": 1, "unit": ")" + unit + R"(", )" + more +
         R"("camera": {"eye": [0, -4, 0], "gaze": [0, 1, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60, "resolution": [8, 6]},)"
         R"("materials": {"a": {"k_d": [0.1, 0.2, 0.3]}}, "objects": [)" +
         objects + "]}";
}

inline Scene read(const TemporaryFolder& folder, const std::string& text) {
  auto scene = read_scene(folder.add("scene.json", text));
  if (!scene) throw std::runtime_error(scene.error().message);
  return scene->scene;
}

}  // namespace etendue::validation
