// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/byte_text.hpp"

#include <bit>

namespace etendue {

namespace {

template <class Word>
void append_word(std::string& bytes, Word value) {
  for (std::size_t k = 0; k < sizeof value; ++k, value >>= 8) bytes += static_cast<char>(value & 0xFF);
}

}  // namespace

void append_little(std::string& bytes, std::uint64_t value) {
  append_word(bytes, value);
}

void append_little(std::string& bytes, std::uint32_t value) {
  append_word(bytes, value);
}

void append_little(std::string& bytes, double value) {
  append_word(bytes, std::bit_cast<std::uint64_t>(value));
}

void append_little(std::string& bytes, float value) {
  append_word(bytes, std::bit_cast<std::uint32_t>(value));
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t held = bytes.size() - at < 3 ? bytes.size() - at : 3;
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (k < held ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= held ? kDigits[three >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string npy_header(std::size_t rows, std::size_t columns) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " +
                       std::to_string(columns) + "), }";
  constexpr std::size_t kBefore = 10, kAlignment = 64;  // magic and lengths; what NumPy aligns data to
  header.append(kAlignment - 1 - (kBefore + header.size()) % kAlignment, ' ');
  header += '\n';
  const char lengths[] = {1, 0, static_cast<char>(header.size() & 0xFF), static_cast<char>(header.size() >> 8)};
  return "\x93NUMPY" + std::string(lengths, sizeof lengths) + header;
}

}  // namespace etendue
