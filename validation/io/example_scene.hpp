// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {

/// The example of docs/scene-format.md, which has every kind of thing once.
inline std::string example_scene() {
  const std::string page = read_text(source_root() / "docs" / "scene-format.md");
  const std::string fence = "```json\n";
  const std::size_t begin = page.find(fence) + fence.size();
  return page.substr(begin, page.find("```", begin) - begin);
}

}  // namespace etendue::validation
