// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// The parts as one text, doubles with the fewest digits that give them back.
template <class... Parts>
[[nodiscard]] std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  const auto add = [&text](const auto& part) {
    if constexpr (std::is_same_v<std::decay_t<decltype(part)>, double>) {
      char digits[32];
      const auto end = std::to_chars(digits, digits + sizeof digits, part).ptr;
      text << std::string_view(digits, static_cast<std::size_t>(end - digits));
    } else {
      text << part;
    }
  };
  (add(parts), ...);
  return text.str();
}

}  // namespace etendue
