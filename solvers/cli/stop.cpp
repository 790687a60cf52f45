// SPDX-License-Identifier: Apache-2.0
#include "stop.hpp"

#include <csignal>

namespace etendue::cli {

namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void raise_stop(int) {
  stop = true;
}

}  // namespace

const std::atomic<bool>& stop_requested() {
  return stop;
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
