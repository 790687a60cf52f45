// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "grade/cases.hpp"
#include "support/process.hpp"

namespace etendue::validation {

enum class Mark { passed, failed, unsupported, not_run };
const char* name(Mark mark);

/// What became of one case.
struct CaseVerdict {
  Mark mark = Mark::not_run;
  std::optional<double> share;  ///< distance from the enclosure in tolerances; none where there is no number to judge
  std::string answer;           ///< as JSON; empty where there is none
  std::string reason;           ///< of a failure, or why it is not supported
  double seconds = 0;
};

/// Judges what a program printed for a case, and how it ended. An answer is {"value": …} or {"unsupported": "reason"}: a number, an
/// array of as many numbers as are asked for, or "none". Right is what lies within the tolerance of [low, high], each number by itself.
[[nodiscard]] CaseVerdict judge(const GradeCase& asked, const Ended& ended);

}  // namespace etendue::validation
