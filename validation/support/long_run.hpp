// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace etendue::validation {

/// How many cases a random family has: `cases`, times the whole number in ETENDUE_LONG_RUN where that is set
/// (ci/long-run; etendue-validate --long). The first `cases` are the same in any run.
inline std::uint64_t long_run(std::uint64_t cases) {
  const char* factor = std::getenv("ETENDUE_LONG_RUN");
  const std::uint64_t times = factor == nullptr ? 1 : std::strtoull(factor, nullptr, 10);
  return cases * (times == 0 ? 1 : times);
}

/// Of a table whose rows are costly, every `step`-th one; all of them in a run `step` times as long.
inline std::size_t every(std::size_t step) {
  const std::uint64_t times = long_run(1);
  return times >= step ? 1 : step / static_cast<std::size_t>(times);
}

/// What --long means, where the environment does not say another number.
inline void begin_long_run() {
  ::setenv("ETENDUE_LONG_RUN", "100", 0);
}

/// Is told the share of the running test that is done; null where nobody looks.
inline void (*on_share_done)(double share) = nullptr;

/// For loops that a long run makes long: `done` of `of` cases are.
inline void share_done(std::uint64_t done, std::uint64_t of) {
  if (on_share_done != nullptr) on_share_done(static_cast<double>(done) / static_cast<double>(of));
}

}  // namespace etendue::validation
