// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace etendue {

/// The fewest digits that read as the same double.
[[nodiscard]] std::string shortest(double value);

/// `digits` significant digits at most, as printf's %g has them: for people, not to be read back.
[[nodiscard]] std::string rounded(double value, int digits = 4);

/// "1 object", "3 objects": the plural is made by an s.
[[nodiscard]] std::string counted(std::size_t count, const char* what);

/// "1 error", "3 errors".
[[nodiscard]] std::string counted_errors(std::size_t count);

}  // namespace etendue
