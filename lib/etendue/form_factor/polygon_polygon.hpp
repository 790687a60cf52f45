// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/bounded.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// Unobstructed form factor F_12: the fraction of the power leaving `from` that arrives at `to`.   @eq IU.6-3
[[nodiscard]] Bounded form_factor(const Polygon& from, const Polygon& to, Tolerance tolerance = {});

}  // namespace etendue
