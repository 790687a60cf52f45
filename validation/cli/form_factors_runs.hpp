// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "support/process.hpp"

// What the tests of the command form-factors share.
namespace etendue::validation {

inline std::string furnace() {
  return (source_root() / "scenes" / "furnace" / "scene.json").string();
}

inline Ended form_factors(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "form-factors");
  return run_etendue(arguments);
}

inline bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace etendue::validation
