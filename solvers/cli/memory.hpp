// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace etendue::cli {

/// Memory [bytes] that this process can still get: the least of what the kernel counts as available, what its control
/// group leaves, and what RLIMIT_AS leaves. Nothing where the kernel does not say.
[[nodiscard]] std::optional<double> available_memory();

}  // namespace etendue::cli
