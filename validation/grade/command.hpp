// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace etendue::validation {

/// `etendue-validate grade [OPTIONS] -- COMMAND …`: runs any program on the cases, one process a case, and prints its score card; or
/// exports the cases. Arguments are those behind "grade".
///
/// Returns   0 all that was answered is right, and something was; 1 a case failed, or none was answered; 2 usage; 3 a case is
///           malformed; 5 a file cannot be read or written, or the program not be started; 6 stopped, the score card of what was run printed
int grade(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace etendue::validation
