// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/mailbox.hpp"

#include <atomic>

namespace etendue {

std::uint64_t Mailbox::unused_owner() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace etendue
