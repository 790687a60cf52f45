// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/furnace_text.hpp"
#include "support/process.hpp"

// Runs of `etendue solve` on the furnace and what stands in it, for more than one file of tests.
namespace etendue::validation {

/// The furnace with further objects before its own.
inline std::string furnace_with(const std::string& objects) {
  return replaced(furnace_text(), "\"objects\": [", "\"objects\": [" + objects + ",");
}

/// One of them, in the way of most pairs.
inline constexpr const char* kScreen =
    R"({"type": "polygon", "name": "screen", "material": "glowing",
        "vertices": [[0.5, 1, 0.4], [1.4, 1.3, 0.4], [1.4, 1.3, 1.1], [0.5, 1, 1.1]]})";

/// etendue solve, with out.png beside the scene.
inline Ended solve(const std::filesystem::path& scene, std::vector<std::string> more,
                   const ProcessOptions& options = {}) {
  more.insert(more.begin(), {"solve", scene.string(), "--output", (scene.parent_path() / "out.png").string()});
  return run_etendue(more, options);
}

inline bool says(const Ended& ended, const std::string& words) {
  return (ended.out + ended.err).find(words) != std::string::npos;
}

}  // namespace etendue::validation
