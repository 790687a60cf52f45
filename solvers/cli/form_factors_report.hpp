// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "etendue/assembly/row_closure.hpp"
#include "etendue/assembly/surface_model.hpp"

namespace etendue::cli {

/// What `etendue form-factors` found out about a whole scene.
struct MatrixReport {
  const SurfaceModel& model;
  const ExchangeMatrix& matrix;
  const RowClosure& closure;
  std::string method;
  Tolerance tolerance;
  std::filesystem::path scene, output;  ///< output: empty where no file is asked for
  std::vector<std::string> remarks;     ///< what stands out, and what was done to the matrix: repair, dropped factors
  double seconds = 0;
};

/// One remark that names rows that see nothing because they lie inside or under others; nothing where there are none.
[[nodiscard]] std::vector<std::string> buried_remark(const SurfaceModel& model, const RowClosure& closure);

void print_matrix_report(std::ostream& out, const MatrixReport& report);
/// One JSON object; numbers to the last bit.
[[nodiscard]] std::string matrix_report_json(const MatrixReport& report);

/// What it found out about one pair of rows.
struct PairReport {
  const SurfaceModel& model;
  std::size_t from, to;
  Bounded forth, back;  ///< F_ij and F_ji
  TileReport what;      ///< of the elements' pairs
  std::vector<std::string> blockers;
  std::string method;
  bool reached = true;
  std::vector<std::string> manners;  ///< how the elements' pairs were found, where the method tells
};

void print_pair_report(std::ostream& out, const PairReport& report);
[[nodiscard]] std::string pair_report_json(const PairReport& report);

}  // namespace etendue::cli
