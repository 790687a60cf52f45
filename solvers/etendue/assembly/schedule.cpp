// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/schedule.hpp"

namespace etendue {

Schedule on_threads(int threads) {
  return [threads](Eigen::Index count, const std::function<void(Eigen::Index)>& body) {
    Execution execution;
    execution.threads = threads;
    parallel_for(static_cast<std::size_t>(count), execution,
                 [&body](std::size_t item) { body(static_cast<Eigen::Index>(item)); });
  };
}

}  // namespace etendue
