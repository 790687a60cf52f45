// SPDX-License-Identifier: Apache-2.0
#include "stop.hpp"

#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <string_view>

#include "etendue/core/result.hpp"

namespace etendue::cli {

namespace {

std::atomic<bool> stop{false};
std::atomic<bool> nothing_to_save{false};
std::atomic<std::int64_t> first_at{0};  ///< when the first signal came [ns of the monotonic clock]; 0: none yet
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// One request may bring several signals: timeout(1) signals its command and then the command's whole group, within
/// microseconds, and a hand may strike twice. Who sees that stopping takes its time, and presses again, needs longer.
constexpr std::int64_t kOneRequest = 1'000'000'000;  // ns

/// Only what a signal handler may call.
[[noreturn]] void end_now() {
  constexpr std::string_view kMessage = "etendue: stopped before anything was done\n";
  // Whether the message gets through or not, the exit code tells.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  ::_exit(static_cast<int>(ErrorCode::stopped));
}

std::int64_t now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

void raise_stop(int signal) {
  if (nothing_to_save) end_now();
  const int before = errno;  // of what the signal has interrupted
  std::int64_t first = 0;
  const std::int64_t time = now();
  // Two threads may be here at once: the one that comes second finds the other's time, at most a moment away.
  if (!first_at.compare_exchange_strong(first, time) && time - first > kOneRequest) {
    ::signal(signal, SIG_DFL);
    ::raise(signal);  // held back until this handler returns
  }
  stop = true;
  errno = before;
}

}  // namespace

const std::atomic<bool>& stop_requested() {
  return stop;
}

NothingToSave::NothingToSave() {
  nothing_to_save = true;
  if (stop) end_now();  // the signal came just before
}

NothingToSave::~NothingToSave() {
  nothing_to_save = false;
}

void watch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = raise_stop;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // A signal that our parent had us ignore (nohup, a background job) stays ignored.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

}  // namespace etendue::cli
