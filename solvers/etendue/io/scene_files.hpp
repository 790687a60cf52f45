// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "etendue/core/result.hpp"
#include "etendue/io/scene_node.hpp"
#include "etendue/text/fingerprint.hpp"

namespace etendue {

/// One of the files that make a scene.
struct LoadedFile {
  std::size_t index = 0;  ///< in reading order; 0 is the file that was asked for
  std::string name;       ///< what messages call it
  JsonDocument document;
  double metres_per_unit = 1;
  bool sound = false;  ///< its text is JSON, its top is a scene of this format with a unit
};

/// All files of a scene, in the order in which their contents come: what a file includes before the file itself.
struct LoadedFiles {
  std::deque<LoadedFile> files;
  bool complete = true;     ///< false when a file is missing or is not JSON: then names may seem unknown that are not
  Fingerprint fingerprint;  ///< of their bytes and lengths
};

/// Reads a file and, following "include", those it needs, each once. Reports what is wrong with their outline: syntax,
/// repeated keys, unknown keys at the top, format, version, unit, missing files, cycles.
/// Errors    input_output: the first file cannot be read.
[[nodiscard]] Result<LoadedFiles> load_scene_files(const std::filesystem::path& path, SceneErrors& errors);

/// Metres in the unit that this names; reported where it names none.
[[nodiscard]] std::optional<double> read_unit(const SceneNode& node);

}  // namespace etendue
