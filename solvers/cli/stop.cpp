// SPDX-License-Identifier: Apache-2.0
#include "stop.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "etendue/core/result.hpp"

namespace etendue::cli {

namespace {

std::atomic<bool> stop{false};
std::atomic<bool> nothing_to_save{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

/// Only what a signal handler may call.
[[noreturn]] void end_now() {
  constexpr std::string_view kMessage = "etendue: stopped before anything was done\n";
  // Whether the message gets through or not, the exit code tells.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  ::_exit(static_cast<int>(ErrorCode::stopped));
}

void raise_stop(int) {
  if (nothing_to_save) end_now();
  stop = true;
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
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);  // reset: the second signal has its usual effect
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // A signal that our parent had us ignore (nohup, a background job) stays ignored.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

}  // namespace etendue::cli
