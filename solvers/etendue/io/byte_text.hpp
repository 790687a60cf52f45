// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// Bytes as files of numbers want them, the same on every machine.
namespace etendue {

/// Appends the value's bytes, the least significant first.
void append_little(std::string& bytes, std::uint64_t value);
void append_little(std::string& bytes, std::uint32_t value);
void append_little(std::string& bytes, double value);
void append_little(std::string& bytes, float value);

/// The other way round: what the front of the bytes, of which there are enough, was made of.
template <class Word>
[[nodiscard]] Word read_little(std::string_view bytes) {
  Word value = 0;
  for (std::size_t k = 0; k < sizeof value; ++k)
    value |= static_cast<Word>(static_cast<unsigned char>(bytes[k])) << (8 * k);
  return value;
}

/// RFC 4648 with padding, in one line.
[[nodiscard]] std::string base64(std::string_view bytes);

/// What stands before rows × columns little-endian doubles, row by row, in NumPy's format 1.0: magic, version, length of
/// the header, header, padded so that the numbers begin at a multiple of 64 bytes.
[[nodiscard]] std::string npy_header(std::size_t rows, std::size_t columns);

}  // namespace etendue
