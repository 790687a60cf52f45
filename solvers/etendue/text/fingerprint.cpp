// SPDX-License-Identifier: Apache-2.0
#include "etendue/text/fingerprint.hpp"

namespace etendue {

Fingerprint& Fingerprint::add(std::string_view bytes) {
  for (const char byte : bytes) state_ = (state_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return *this;
}

std::string Fingerprint::hex() const {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(state_ >> shift) & 0xF];
  return text;
}

}  // namespace etendue
