// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/execution/execution.hpp"
#include "etendue/radiosity/form_factors.hpp"

namespace etendue {

/// Lends this many threads (0: all cores) to products with form factors. Never changes their bits.
[[nodiscard]] Schedule on_threads(int threads);

}  // namespace etendue
