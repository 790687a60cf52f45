// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace etendue::cli {

/// Pictures of a saved solution: any view, nothing solved again.                                          @eq IU.6.5v
int view(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace etendue::cli
