// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runner/history.hpp"
#include "runner/summary.hpp"

// The four forms of the report. All but durations and the date is the same from run to run.
namespace etendue::validation {

/// How the program that made a report was built, and when it ran.
struct BuildInfo {
  std::string version;
  std::string compiler;
  std::string build_type;
  std::string contraction;  ///< the value of -ffp-contract
  std::string date;         ///< UTC, ISO 8601
  double seconds = 0;       ///< wall-clock time of all tests
  std::string command;      ///< the command line that repeats the run
};

/// Table claim → oracle → worst error → verdict, open rows, problems, headline.
std::string text_report(const Summary& summary, const BuildInfo& build);

/// Schema "etendue-validation-report/1"; documented in validation/runner/README.md.
std::string json_report(const Summary& summary, const Register& all, const BuildInfo& build);

/// JUnit XML: one testsuite a test suite, claims and oracle as properties.
std::string junit_report(const Summary& summary, const BuildInfo& build);

/// One HTML file, complete in itself (docs/report.md): readable without a script, whose data the page checks again with one.
std::string html_report(const Summary& summary, const Register& all, const BuildInfo& build,
                        const std::vector<PastRun>& past);

/// The machine, and what the program is made of, with licences: name and text.
std::vector<std::pair<std::string, std::string>> environment();

/// Made by validation/report/embed.py: the page without its data, and as JSON what each test states and the formulas in MathML.
std::string_view embedded_page();
std::string_view embedded_statements();

/// The worst share of a tolerance as the table shows it: "exact", "0.42", "1.3e-05".
std::string share_text(double share);

}  // namespace etendue::validation
