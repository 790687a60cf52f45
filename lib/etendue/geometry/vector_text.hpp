// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// "(x, y, z)", with 17 digits: the point that a refusal names can be found again.
[[nodiscard]] std::string text(const Vec3& v);

}  // namespace etendue
