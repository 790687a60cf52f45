// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace etendue::fuzz {

/// Any bytes, of which a target makes what it tries.
using Bytes = std::span<const std::uint8_t>;

/// One thing that must stand any input: it returns, or calls fail().
struct Target {
  std::string_view name;  ///< of its folder in validation/fuzz/corpus, too
  void (*run)(Bytes input);
};

[[nodiscard]] const std::vector<Target>& reader_targets();
[[nodiscard]] const std::vector<Target>& kernel_targets();

/// All of them; null where none has this name.
[[nodiscard]] const Target* find_target(std::string_view name);

/// Says what does not hold and ends the program as a crash does, which libFuzzer and ctest both see.
[[noreturn]] void fail(const char* what);
inline void expect(bool holds, const char* what) {
  if (!holds) fail(what);
}

}  // namespace etendue::fuzz
