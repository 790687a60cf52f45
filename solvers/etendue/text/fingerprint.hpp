// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace etendue {

/// 64-bit FNV-1a: tells versions of a file apart; no protection against forgery is meant.
class Fingerprint {
 public:
  Fingerprint& add(std::string_view bytes);
  std::uint64_t value() const { return state_; }
  std::string hex() const;  ///< 16 digits

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace etendue
