// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "runner/options.hpp"
#include "runner/register.hpp"

namespace etendue::validation {

/// GoogleTest's filter for the tests that the options choose, by --filter, --claim or --subject; empty where they choose
/// none of these. Refuses what the register does not have and what selects no test: a check that silently checks nothing.
[[nodiscard]] Result<std::string> gtest_filter(const Options& options, const Register& all);

/// The tests of commands (validation/cli), which run the program hundreds of times; no claim rests on them alone.
std::vector<std::string> command_tests();

/// The same choice as words of a command line, each after a blank: " --claim 'IU.6-3' --long".
std::string choice_text(const Options& options);

}  // namespace etendue::validation
