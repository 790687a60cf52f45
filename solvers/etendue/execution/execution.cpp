// SPDX-License-Identifier: Apache-2.0
#include "etendue/execution/execution.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace etendue {

namespace {

std::size_t thread_count(std::size_t count, int wanted) {
  const std::size_t cores =
      wanted > 0 ? static_cast<std::size_t>(wanted) : std::max(1u, std::thread::hardware_concurrency());
  return std::clamp<std::size_t>(cores, 1, std::max<std::size_t>(count, 1));
}

}  // namespace

bool parallel_for(std::size_t count, const Execution& execution, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
  std::mutex mutex;

  const auto work = [&] {
    while (!failed && !execution.stopping()) {
      const std::size_t item = next++;
      if (item >= count) return;
      try {
        body(item);
      } catch (...) {  // carried to the caller's thread, not swallowed
        const std::lock_guard lock(mutex);
        if (!failed.exchange(true)) failure = std::current_exception();
        return;
      }
      const std::lock_guard lock(mutex);
      ++done;
      if (execution.progress) execution.progress(done, count);
    }
  };

  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < thread_count(count, execution.threads); ++i) threads.emplace_back(work);
  work();
  for (auto& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
  return done == count;
}

}  // namespace etendue
