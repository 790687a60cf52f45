// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "etendue/gather/sensors.hpp"
#include "etendue/io/sensor_file.hpp"
#include "etendue/optics/photometry.hpp"
#include "options.hpp"
#include "report_json.hpp"

namespace etendue::cli {

struct SolveReport;

/// What `etendue solve --sensors` was asked.
struct SensorRequest {
  std::filesystem::path file;  ///< empty: no sensors
  double efficacy = kWhiteEfficacy;
  bool extrapolate = false;

  bool asked() const { return !file.empty(); }
};

/// Sensors, and what they were found to receive.
struct SensorReport {
  std::vector<Sensor> sensors;
  std::vector<SensorResult> results;  ///< as many, once measured
  double efficacy = kWhiteEfficacy;
  std::size_t coarse_elements = 0;      ///< of the mesh that was extrapolated from; 0 where none was
  std::vector<std::string> not_halved;  ///< objects whose elements were the same in that mesh: not_halved()
  std::filesystem::path csv;
};

/// Declares --sensors and --efficacy.
void add_sensors(Options& options, SensorRequest& request);
/// Declares --extrapolate, which takes a method that solves two meshes alike.
void add_extrapolation(Options& options, SensorRequest& request);

/// What parsing cannot see.
[[nodiscard]] std::optional<std::string> contradiction(const SensorRequest& request);

/// Reads the sensors of a scene, and asks whether the table can be written.
[[nodiscard]] Result<SensorReport> opened_sensors(const SensorRequest& request, const SceneFile& scene,
                                                  const std::filesystem::path& csv);

/// What sensors look at.
struct SolvedElements {
  const ElementMesh& mesh;
  std::span<const Rgb> radiosity;
  std::span<const std::size_t> covered;
  Rgb bound;  ///< on |B_k − exact B_k|, infinite where it is not known
};

/// Measures at the sensors of a report; ErrorCode::stopped when the user asked for it meanwhile.
[[nodiscard]] Result<SensorReport> measured(const SolvedElements& solved, SensorReport sensors,
                                            const Execution& execution);

/// Solves a scene on a mesh of its own: what `measured` does again with half the elements.
using SolveAgain = std::function<Result<SolveReport>(Scene scene)>;

/// Measures at the sensors of `report`, which is solved; with `again` on both meshes.
[[nodiscard]] Result<SensorReport> measured(const SolveReport& report, SensorReport sensors, const SolveAgain& again,
                                            const Execution& execution);

/// Lines for a person: how many, how bright, how certain.
void print_sensors(std::ostream& out, const SensorReport& sensors);

/// "sensors" of NAME.json; @param all whether each reading is listed
[[nodiscard]] Json sensors_json(const SensorReport& sensors, bool all);

}  // namespace etendue::cli
