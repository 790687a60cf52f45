// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "etendue/io/solution_file.hpp"
#include "options.hpp"

// What all methods of `etendue solve` share.
namespace etendue::cli {

/// The output's name with another ending; never that of the scene itself, where no name is asked for.
[[nodiscard]] std::filesystem::path solution_path(const std::filesystem::path& output,
                                                  const std::filesystem::path& scene, const char* ending);

/// Declares --write, by which a solution goes into files for other programs too.
void add_write(Options& options, std::vector<std::filesystem::path>& files);

/// Writes the solution to these files, all or none.
[[nodiscard]] Result<Done> write_solutions(const std::vector<std::filesystem::path>& files,
                                           const SolvedSurfaces& solved);

/// What radiosity leaves out of this scene, one line each.
[[nodiscard]] std::vector<std::string> left_out(const Scene& scene);

}  // namespace etendue::cli
