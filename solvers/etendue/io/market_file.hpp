// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "etendue/core/result.hpp"
#include "etendue/radiosity/form_factors.hpp"

namespace etendue {

/// A matrix in MatrixMarket form: coordinate or array, real or integer, general or symmetric.
///
/// Errors    "F.mtx:7: …", the line named: another form, an entry that is no number, not finite, outside of the matrix or
///           there twice, more or fewer entries than promised; input_output as read_file()
[[nodiscard]] Result<SparseRows> read_market(const std::filesystem::path& path);

}  // namespace etendue
