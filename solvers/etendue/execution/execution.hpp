// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace etendue {

/// How a long computation runs: on how many threads, whom it tells, and who may stop it. Never changes a result's bits.
struct Execution {
  /// 0: all cores
  int threads = 0;
  /// Called from one thread at a time; may be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
  /// When it turns true, no further item is begun; may be null.
  const std::atomic<bool>* stop = nullptr;

  bool stopping() const { return stop && *stop; }
};

/// Calls body(i) once for each i in [0, count), in any order, on execution.threads threads, and tells whether all were
/// done (false: stopped). Each i must write only what belongs to i; reductions are the caller's, in a fixed order.
/// An exception of the body stops the rest and is thrown again here.
bool parallel_for(std::size_t count, const Execution& execution, const std::function<void(std::size_t)>& body);

}  // namespace etendue
