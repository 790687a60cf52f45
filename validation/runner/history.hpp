// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "etendue/core/result.hpp"

// Earlier runs, from their JSON reports.
namespace etendue::validation {

/// What the page tells of one.
struct PastRun {
  std::string date, version;
  bool ok = false;
  double seconds = 0;
  int passed = 0, failed = 0, verified = 0, refuted = 0, open = 0;
  int other_problems = 0;  ///< beside failed tests: problems, and tests that were not run
  std::vector<std::pair<std::string, std::string>> verdicts;  ///< id and verdict of each claim and erratum
};

/// From the text of a JSON report, or nothing where it is none.
[[nodiscard]] std::optional<PastRun> past_run(const std::string& json);

/// Reads them, the oldest first whatever the order of the files.
///
/// Errors    input_output, of a file; invalid_input: what is not a JSON report of etendue-validate
[[nodiscard]] Result<std::vector<PastRun>> read_history(const std::vector<std::string>& paths);

/// A row whose verdict was another in the latest run of the past.
struct Change {
  std::string id, then, now;
};
std::vector<Change> changes_since(const PastRun& past, const std::vector<std::pair<std::string, std::string>>& now);

/// The section of the page, with the run of now as the last row, and its data. Nothing to see without a past.
std::string history_html(const std::vector<PastRun>& past, const PastRun& now);
std::string history_json(const std::vector<PastRun>& past, const PastRun& now);

}  // namespace etendue::validation
