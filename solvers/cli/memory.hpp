// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "etendue/core/result.hpp"

namespace etendue::cli {

/// Memory [bytes] that this process can still get: the least of what the kernel counts as available, what its control
/// group leaves, and what RLIMIT_AS leaves. Nothing where the kernel does not say.
[[nodiscard]] std::optional<double> available_memory();

/// Memory [bytes] that this process has held at most so far. Nothing where the kernel does not say.
[[nodiscard]] std::optional<double> peak_memory();

/// What is to be held at once, and how a refusal words it.
struct MemoryNeed {
  double bytes = 0;
  std::string subject;  ///< "360000 elements need"
  std::string reason;   ///< "40 bytes for each of n² pairs"
  std::string advice;   ///< what to do where that is too much
};

/// To be asked before work whose results this machine may be unable to hold.
///
/// Errors    input_output: the need is more than available_memory()
[[nodiscard]] Result<Done> check_memory(const MemoryNeed& need);

}  // namespace etendue::cli
