// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/radiosity/form_factors.hpp"

namespace etendue {

/// Numbers in rows, as a file holds them.
struct NumberTable {
  RowMatrix values;
  /// The file holds decimal digits, so each value may be off what was meant by half a unit in the last place; otherwise
  /// it holds the doubles themselves.
  bool decimal = false;
  std::vector<std::size_t> lines = {};  ///< of text: where each row stands
};

/// Rows of numbers: NumPy's .npy (versions 1 to 3; `<f8`, `>f8`, `<f4` or `>f4`; one or two dimensions, either order), or text in
/// any other file: one row a line, numbers apart by commas, semicolons, blanks or tabs; empty lines and what follows a
/// '#' do not count.
///
/// Errors    "F.csv:7: …", the line named: what is no number or not finite, rows of different lengths, no numbers at all;
///           input_output as read_file()
[[nodiscard]] Result<NumberTable> read_number_table(const std::filesystem::path& path);

/// Form factors as a file holds them: .mtx sparse, all else dense.
struct FactorsFile {
  std::variant<RowMatrix, SparseRows> factors;
  bool decimal = false;                 ///< as in NumberTable
  std::vector<std::size_t> lines = {};  ///< as in NumberTable
  Eigen::Index size() const;
};

/// Form factors F_ij, row = from, column = to: .mtx is MatrixMarket (coordinate or array; real or integer; general or
/// symmetric), all else read_number_table().
///
/// Errors    those of read_number_table(); a matrix that is not square; in .mtx an entry outside, twice, or missing
[[nodiscard]] Result<FactorsFile> read_factors(const std::filesystem::path& path);

}  // namespace etendue
