// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "etendue/assembly/certified_radiosity.hpp"
#include "etendue/assembly/closure.hpp"
#include "etendue/assembly/scene_radiosity.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/view/vertex_radiosity.hpp"
#include "solve_parts.hpp"
#include "solve_sensors.hpp"

namespace etendue::cli {

/// Everything that `etendue solve` found out.
struct SolveReport : SolutionFiles {
  SceneFile file;
  std::filesystem::path scene_path;
  std::string solver;
  double element_size = 0;  ///< of --element-size; 0: as the scene says
  AssemblyTolerance tolerance;
  std::filesystem::path begun;  ///< with --resume: the rows that an earlier run has saved; empty: none
  ElementMesh mesh;
  FormFactorMatrix matrix;
  ClosureReport closure;
  std::optional<SceneRadiosity> solution;     ///< nothing when stopped before; of some channels when stopped on the way
  std::optional<CertifiedFactors> certified;  ///< asked for by --certify
  std::optional<CertifiedRadiosity> enclosure;
  std::string not_certified;            ///< why there is none although it was asked for
  double certify_tolerance = 0;         ///< relative half width asked of enclosures past obstructions
  std::optional<SensorReport> sensors;  ///< asked for by --sensors, and measured
  VertexRadiosities vertices;
  double exposure = 0;
  double seconds = 0;
};

/// Are all channels solved?
[[nodiscard]] bool is_solved(const SolveReport& report);

/// How many pairs miss the tolerance, which is the worst, what was reached and what was asked.
[[nodiscard]] std::string missed_tolerance_text(const SolveReport& report);
/// How many enclosures are wider than was asked; empty where none is, or none was asked for.
[[nodiscard]] std::string wide_enclosures_text(const SolveReport& report);

/// The summary as a person reads it.
void print_summary(std::ostream& out, const SolveReport& report);

/// The summary as a machine reads it: one JSON object, numbers to the last bit.
[[nodiscard]] std::string summary_json(const SolveReport& report);

/// Summary and every element: object, patch, centroid, area, normal, emission, radiosity, row sum; with --certify
/// "radiosity_interval": of each channel the two numbers between which the exact radiosity lies. When stopped
/// (NAME.incomplete.json), the radiosities of the channels that are solved, and "rows": of each row i that is done the
/// form factors F_ij and their bounds for j = i + 1 … n − 1; F_ji = A_i F_ij / A_j. Numbers are written so that they
/// read as the same double. Equal results are equal bytes: no times, no paths.
[[nodiscard]] std::string full_json(const SolveReport& report);

}  // namespace etendue::cli
