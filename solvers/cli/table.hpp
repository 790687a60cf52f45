// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace etendue::cli {

/// A command of the program: `etendue name …`.
struct Command {
  const char* name;
  const char* summary;
  int (*run)(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);
};

/// All commands, in the order in which --help lists them.
const std::vector<Command>& commands();

/// The whole program but for process matters: picks the command, hands it the rest, turns what escapes from it into a
/// message and an exit code. Data goes to `out`, messages to `err`.
///
/// Returns   0 done, 1 a check failed, 2 usage, 3 invalid input, 4 tolerance or convergence not reached, 5 input/output
///           (or out of memory), 6 stopped with what was done saved. A defect of the program itself, a broken contract,
///           is a failed check: 1. When `out` did not take all data, 0 becomes 5.
int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace etendue::cli
