// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace etendue::cli {

int ray_tree(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace etendue::cli
