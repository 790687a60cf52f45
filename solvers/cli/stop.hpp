// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace etendue::cli {

/// True once the user has asked to stop (Ctrl-C, or a polite kill). A command then ends its current items, saves what
/// is done and returns ErrorCode::stopped.
const std::atomic<bool>& stop_requested();

/// From now on the first SIGINT or SIGTERM raises stop_requested(). What follows within a second belongs to the same
/// request; a later one ends the program at once, as if nobody had watched.
void watch_stop_signals();

/// While one lives, nothing is there to be saved: the first signal ends the program at once, as a stop (6), even where
/// it waits for a pipe that nobody writes to. One at a time.
class NothingToSave {
 public:
  NothingToSave();
  ~NothingToSave();
  NothingToSave(const NothingToSave&) = delete;
  NothingToSave& operator=(const NothingToSave&) = delete;
};

}  // namespace etendue::cli
