// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "options.hpp"

namespace etendue::cli {

/// Declares --method, which both kinds of solve understand.
void add_method(Options& options, std::string& method);

/// Is a method asked for that solve_refined() has, or a solution that it goes on with?
[[nodiscard]] bool asks_for_refinement(const std::vector<std::string>& arguments);

/// `etendue solve` by hemicube, progressive or adaptive.
int solve_refined(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace etendue::cli
