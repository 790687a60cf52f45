// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>

namespace etendue::validation {

/// How many cases a random family has: `cases`, times the whole number in ETENDUE_LONG_RUN where that is set
/// (ci/long-run). The first `cases` are the same in any run.
inline std::uint64_t long_run(std::uint64_t cases) {
  const char* factor = std::getenv("ETENDUE_LONG_RUN");
  const std::uint64_t times = factor == nullptr ? 1 : std::strtoull(factor, nullptr, 10);
  return cases * (times == 0 ? 1 : times);
}

}  // namespace etendue::validation
