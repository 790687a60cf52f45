// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
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

/// Text as a message may show it: one line that no terminal takes for a command, whatever a file or a file name holds.
/// Control characters (C0, DEL, C1), line and paragraph separators and marks that turn the direction of writing appear
/// as `\n`, `\t`, `\x1b`, `\u202e`; bytes that are not UTF-8 as `\xff`. Everything else stays, the backslash too: what is
/// printable already is not changed again. After `longest` characters of the text follows "…".
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// printable() of each line: for messages of several lines that were put together from printable parts.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// 'path', printable, as messages name it.
[[nodiscard]] std::string quoted_path(const std::filesystem::path& path);

}  // namespace etendue
