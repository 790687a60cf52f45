// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "runner/summary.hpp"
#include "support/exhibit.hpp"

// What a process that has run tests tells the one that reports on them. Bits of numbers and bytes of texts survive.
namespace etendue::validation {

/// A finished test, and which it is in the order of all tests.
struct NumberedRun {
  std::size_t index = 0;
  TestRun run;
  std::vector<Exhibit> exhibits;
};

struct WorkDone {
  std::vector<NumberedRun> tests;
  bool gtest_ok = true;  ///< GoogleTest's own opinion, which knows failures outside tests as well
};

std::string to_wire(const WorkDone& work);
/// Contract: the text is whole
WorkDone from_wire(const std::string& text);

}  // namespace etendue::validation
