// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue::cli {

/// What NAME.json of `etendue solve` holds of a solution, whatever its method: enough to show it without its scene.
struct SavedSolution {
  Scene scene;  ///< name, unit, camera, background and the materials, but no object and no light
  std::string hash;
  std::string method;
  bool finished = true;              ///< false: what an interrupted run had so far
  ElementMesh mesh;                  ///< patches not told apart; objects numbered as their names follow one another
  std::vector<Rgb> radiosity;        ///< of each element [W/m²]
  std::vector<std::size_t> covered;  ///< elements that see no front
  Rgb ambient = Rgb::Zero();         ///< B_amb [W/m²]; 0 unless it was asked for
  double exposure = 0;               ///< of its own picture, where linear; 0 where it had none
};

/// Reads such a file.
///
/// Errors    input_output: it cannot be read. invalid_input: it is not such a file, cut short or damaged (which datum), written
///           before elements had corners, or saved before anything was solved
[[nodiscard]] Result<SavedSolution> read_saved_solution(const std::filesystem::path& path);

}  // namespace etendue::cli
