// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "runner/summary.hpp"

namespace etendue::validation {

/// Keeps what every test left behind.
class Collector : public ::testing::EmptyTestEventListener {
 public:
  explicit Collector(std::vector<TestRun>& tests) : tests_(tests) {}
  void OnTestStart(const ::testing::TestInfo& info) override;  ///< skips the test once the user wants to stop
  void OnTestEnd(const ::testing::TestInfo& info) override;

 private:
  std::vector<TestRun>& tests_;
};

enum class Depth { usual, long_run };

/// One line on a terminal that says how far the run is; nothing in a pipe. Of a long run a bar as well, which moves while
/// a test runs, and the time.
class Progress : public ::testing::EmptyTestEventListener {
 public:
  explicit Progress(Depth depth);
  ~Progress() override;
  void OnTestStart(const ::testing::TestInfo& info) override;
  void OnTestProgramEnd(const ::testing::UnitTest& unit) override;

 private:
  void show(double share);

  Depth depth_;
  int begun_ = 0;
  std::string test_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), shown_{};
};

}  // namespace etendue::validation
