// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace etendue::cli {

/// `etendue solve --factors F …`: the radiosity equation without a scene. `solve` hands over whenever it sees --factors.
int solve_factors(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

/// What `--solver` may name, and what each is, for --help.
[[nodiscard]] std::vector<std::string> solver_choices();
extern const char* const kSolverHelp;

}  // namespace etendue::cli
