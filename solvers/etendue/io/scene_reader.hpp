// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// A scene, and the fingerprint of the bytes it was read from.
struct SceneFile {
  Scene scene;
  std::vector<std::filesystem::path> files;  ///< all files read: what was asked for, what it includes, then images
  std::vector<std::string> warnings;         ///< a line each, with its place, for what is odd and yet has a meaning
  /// 16 hex digits: FNV-1a (64 bit) over the bytes of all files read, in reading order, images the last.
  std::string hash;
};

/// Reads a scene file (docs/scene-format.md) and what it includes. Transforms are applied: shapes come out in world
/// coordinates, lengths in the file's unit, angles in radians.
///
/// Errors    input_output: the file, or images and nothing else that it names, cannot be read. invalid_input: one line for each error of the file,
///           "scene.json:12:7: /materials/red/k_d: found -0.1, expected a number in [0, 1]", and their count; a syntax
///           error ends the reading of its file, for what follows it cannot be trusted.
[[nodiscard]] Result<SceneFile> read_scene(const std::filesystem::path& path);

}  // namespace etendue
