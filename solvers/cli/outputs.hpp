// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/io/scene_reader.hpp"

namespace etendue::cli {

/// Path and name, without extension, of what a command makes from a scene: those of --output; without it, in the
/// current folder, the scene's name, or, for a scene.json, that of its folder.
[[nodiscard]] std::filesystem::path output_stem(const std::filesystem::path& output,
                                                const std::filesystem::path& scene);

/// To be asked before a long computation, of all files that it may write: can each be written, and is none of them a
/// file that the scene was read from?
///
/// Errors    usage: it would replace one of `inputs`. input_output: "cannot write 'path': reason".
[[nodiscard]] Result<Done> check_outputs(const std::vector<std::filesystem::path>& outputs,
                                         const std::vector<std::filesystem::path>& inputs);

/// "room, 5 objects, hash 0123…": how reports name what they are about.
[[nodiscard]] std::string scene_line(const SceneFile& file);

/// Prints "etendue command: message", whatever it holds as printable text, and returns the exit code.
int fail(std::ostream& err, const std::string& command, const Error& error);
/// A line each on `err`: "etendue render: warning: scene.json:10:15: …".
void warn(std::ostream& err, const std::string& command, const std::vector<std::string>& warnings);

}  // namespace etendue::cli
