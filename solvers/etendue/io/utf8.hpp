// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace etendue {

/// Offset of the first byte that does not begin or continue a well-formed character (no overlong forms, no surrogates,
/// nothing beyond U+10FFFF), if any.
[[nodiscard]] std::optional<std::size_t> first_invalid_utf8(std::string_view text);

/// Is the byte the second, third or fourth of a character?
constexpr bool is_utf8_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
}

void append_utf8(std::string& text, char32_t character);

/// At most `longest` characters of well-formed text, "…" where more followed; control characters show as '?', so that a
/// message stays one line whatever a file holds.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t longest);

}  // namespace etendue
