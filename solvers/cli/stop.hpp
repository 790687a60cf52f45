// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace etendue::cli {

/// True once the user has asked to stop (Ctrl-C, or a polite kill). A command then ends its current items, saves what
/// is done and returns ErrorCode::stopped.
const std::atomic<bool>& stop_requested();

/// From now on the first SIGINT or SIGTERM raises stop_requested(); the second ends the program at once.
void watch_stop_signals();

}  // namespace etendue::cli
