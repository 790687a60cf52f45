// SPDX-License-Identifier: Apache-2.0
#include "validate_command.hpp"

#include <ostream>

#include "etendue/core/result.hpp"
#include "options.hpp"

namespace etendue::cli {

int validate(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Options options("validate", "Not built yet.");
  if (const auto code = options.parse(arguments, out, err)) return *code;
  err << "etendue validate: not built yet\n";
  return static_cast<int>(ErrorCode::usage);
}

}  // namespace etendue::cli
