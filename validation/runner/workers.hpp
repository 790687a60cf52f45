// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "runner/listeners.hpp"
#include "runner/summary.hpp"

namespace etendue::validation {

/// What a run of the selected tests left behind.
struct TestsDone {
  std::vector<TestRun> tests;         ///< in the order of the program, whoever ran them
  std::vector<std::string> problems;  ///< a process that ended within a test, and in which
  bool gtest_ok = true;               ///< GoogleTest's own opinion, which knows failures outside tests as well
};

/// Runs the tests that GoogleTest selects in `jobs` processes: each takes the next test that none has begun. Figures come to
/// collected_exhibits() as if they had been shown here. A process that crashes costs the test it was running, and what it
/// had already run.
/// Contract: jobs ≥ 1; no thread runs yet.
[[nodiscard]] Result<TestsDone> run_in_workers(int jobs, Depth depth);

}  // namespace etendue::validation
