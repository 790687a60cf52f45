// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "grade/judge.hpp"

namespace etendue::validation {

/// How a program did on the cases of one subject, or of all.
struct Tally {
  std::string subject;
  std::size_t cases = 0, passed = 0, failed = 0, unsupported = 0, not_run = 0;
  double worst = 0;        ///< greatest distance from an enclosure, in tolerances
  std::string worst_case;  ///< whose that is; empty where every answer lies in its enclosure
};

/// Cases and verdicts belong together by their places.
struct Score {
  std::vector<std::string> command;
  std::vector<GradeCase> cases;
  std::vector<CaseVerdict> verdicts;

  /// A row a subject, in the order of the cases' ids.
  [[nodiscard]] std::vector<Tally> by_subject() const;
  [[nodiscard]] Tally total() const;
  /// Has the program answered something, and nothing wrong?
  [[nodiscard]] bool good() const;
};

/// The score card: the table, then each failed case with its reason, then how many are not supported and why, then a line that sums up.
[[nodiscard]] std::string text_score(const Score& score);
[[nodiscard]] std::string json_score(const Score& score);

}  // namespace etendue::validation
