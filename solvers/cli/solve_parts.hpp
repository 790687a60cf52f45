// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "etendue/scene/scene.hpp"

// What all methods of `etendue solve` share.
namespace etendue::cli {

/// The output's name with another ending; never that of the scene itself, where no name is asked for.
[[nodiscard]] std::filesystem::path solution_path(const std::filesystem::path& output,
                                                  const std::filesystem::path& scene, const char* ending);

/// What radiosity leaves out of this scene, one line each.
[[nodiscard]] std::vector<std::string> left_out(const Scene& scene);

}  // namespace etendue::cli
