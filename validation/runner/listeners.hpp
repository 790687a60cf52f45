// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

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

/// One line on a terminal that says how far the run is; nothing in a pipe.
class Progress : public ::testing::EmptyTestEventListener {
 public:
  void OnTestStart(const ::testing::TestInfo& info) override;
  void OnTestProgramEnd(const ::testing::UnitTest& unit) override;

 private:
  int done_ = 0;
};

}  // namespace etendue::validation
