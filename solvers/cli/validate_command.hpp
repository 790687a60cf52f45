// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace etendue::cli {

/// Becomes the program etendue-validate that lies beside this one; `arguments` are its business, --help included.
/// Returns only when there is no such program (5).
int validate(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace etendue::cli
