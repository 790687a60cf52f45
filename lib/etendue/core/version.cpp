// SPDX-License-Identifier: Apache-2.0
#include "etendue/core/version.hpp"

namespace etendue {

const char* version() {
  return ETENDUE_VERSION;
}

}  // namespace etendue
