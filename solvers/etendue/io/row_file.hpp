// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "etendue/assembly/form_factor_matrix.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// What rows of form factors were computed from: the name of each datum, and its value. No line breaks.
using RowsKey = std::vector<std::pair<std::string, std::string>>;

/// Writes the rows of a matrix that are done, right of the diagonal, to the last bit, with what there is to report of
/// them: 16 bytes a pair. For read_rows() only; the form may change between versions, which the key should name.
///
/// Errors    as write_pieces()
[[nodiscard]] Result<Done> write_rows(const std::filesystem::path& path, const RowsKey& key,
                                      const FormFactorMatrix& matrix);

/// Reads them: a matrix of n elements that assemble_form_factors() goes on with; left of the diagonal it is zero.
///
/// Errors    input_output: it cannot be read. invalid_input: not such a file, damaged (its checksum does not hold), or
///           written with another key; the message names the first datum that differs, and both values
[[nodiscard]] Result<FormFactorMatrix> read_rows(const std::filesystem::path& path, const RowsKey& key, std::size_t n);

}  // namespace etendue
