// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"

namespace etendue::validation {

/// What is right: each number lies in [low, high]; or there is nothing to be found.
struct Enclosure {
  bool none = false;
  bool array = false;  ///< asked is an array of numbers, else one number
  std::vector<double> low, high;
};

/// A case as validation/cases holds it, by validation/cases/case.schema.json.
struct GradeCase {
  std::string id, subject, title;
  std::string question;  ///< the file that a program is given: everything but the truths
  std::string file;      ///< the file as it lies there
  Enclosure truth;
  double tolerance = 0;
};

/// The cases that belong to this program's sources.
[[nodiscard]] std::filesystem::path own_cases();

/// All cases in a folder and its subfolders (*.json but *.schema.json), by their ids.
///
/// Errors    input_output: a file cannot be read; invalid_input: "'path': what is wrong with it", two cases of one id, no case at all
[[nodiscard]] Result<std::vector<GradeCase>> read_cases(const std::filesystem::path& folder);

}  // namespace etendue::validation
