// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "etendue/core/contract.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {

/// scenes/furnace/scene.json.
inline std::string furnace_text() {
  return read_text(source_root() / "scenes" / "furnace" / "scene.json");
}

/// `text` with the first `original` in it replaced; it must be there.
inline std::string replaced(std::string text, const std::string& original, const std::string& instead) {
  const std::size_t at = text.find(original);
  require(at != std::string::npos, "replaced: the scene holds what is to be replaced");
  return text.replace(at, original.size(), instead);
}

}  // namespace etendue::validation
