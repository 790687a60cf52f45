// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/core/result.hpp"

namespace etendue::validation {

/// What the command line of etendue-validate asks for.
struct Options {
  enum class Action { run, help, version, list, claims, update_references };
  Action action = Action::run;
  std::vector<std::string> filters;   ///< ids or patterns; a test runs if it fits any of these three
  std::vector<std::string> claims;    ///< ids of the register
  std::vector<std::string> subjects;  ///< subjects of the register, or folders of tests
  std::string text_path;
  std::string json_path;
  std::string junit_path;
  std::string html_path;
  std::vector<std::string> history;        ///< JSON reports of earlier runs, for the HTML page
  std::string references;                  ///< which to update: "all", or how their paths begin
  std::string reason;                      ///< why
  int jobs = 0;                            ///< processes at a time; 0: as many as there are cores
  bool all = false;                        ///< the tests of commands as well
  bool deep = false;                       ///< the long version of tests that have one; and all of them
  bool quiet = false;                      ///< nothing but failures and the headline on stdout
  std::vector<std::string> gtest_options;  ///< handed on to GoogleTest as they are
};

/// Refuses unknown options (naming the nearest known one), missing values and stray arguments.
[[nodiscard]] Result<Options> parse_options(const std::vector<std::string>& arguments);

/// The text of --help; ends with sample runs.
const char* help_text();

/// Does `text` fit `pattern`, where * stands for any characters and ? for one?
bool fits(const std::string& text, const std::string& pattern);

}  // namespace etendue::validation
