// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "etendue/assembly/exchange_matrix.hpp"
#include "etendue/assembly/row_closure.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// What goes into a file beside the numbers.
struct MatrixFacts {
  std::string program, method, scene, hash;
  std::optional<double> metres_per_unit;  ///< of the areas; nothing where the scene's file does not say
  Tolerance tolerance;
  std::vector<std::string> names;
  std::vector<double> emittances;
  bool repaired = false;  ///< closure was forced: the values are no longer as computed
};

/// Can factors be written to this file? Its ending chooses the form: .csv, .npy, .mtx, .json or .vf (docs/form-factors.md).
/// Errors    usage
[[nodiscard]] Result<Done> check_matrix_path(const std::filesystem::path& path);

/// Writes the factors F_ij, row by row, atomically; never holds more than a row besides the matrix.
///
/// Accuracy  .csv, .mtx, .json: 17 significant digits, .npy: all bits; .vf as View3D prints them, 6 decimal places
/// Errors    usage as above; input_output when it cannot be written
[[nodiscard]] Result<Done> write_form_factors(const std::filesystem::path& path, const ExchangeMatrix& matrix,
                                              const RowClosure& closure, const MatrixFacts& facts);

}  // namespace etendue
