// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/core/result.hpp"
#include "options.hpp"

namespace etendue::cli {

/// Declares --accelerator, whose value `target` names: "bvh" by default.
void add_accelerator(Options& options, std::string& target);

/// The accelerator of that name; of "embree", where it cannot be had, the reason.
[[nodiscard]] Result<std::unique_ptr<const Accelerator>> named_accelerator(const std::string& name, const Scene& scene);

}  // namespace etendue::cli
