// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace etendue::cli {

int form_factors(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace etendue::cli
