// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/execution/execution.hpp"
#include "etendue/gather/final_gather.hpp"

namespace etendue {

/// Where irradiance is measured: a small surface, open to the side of its normal.
struct Sensor {
  std::string name;
  Vec3 position = Vec3::Zero();  ///< in scene units
  Vec3 normal = Vec3::UnitZ();   ///< unit
  std::string place = {};        ///< "sensors.csv:7", for messages; empty where it was not read from a file
};

/// Sensors in the middles of the cells of a plane grid, along its first edge fastest; their normal is first × second edge.
///
/// Domain    edges neither zero nor parallel, counts ≥ 1
/// Errors    ContractViolation otherwise
[[nodiscard]] std::vector<Sensor> sensor_grid(const std::string& name, const Vec3& origin, const Vec3& first,
                                              const Vec3& second, int columns, int rows);

/// Refuses sensors where nothing can be measured (FinalGather::obstacle()).
///
/// Errors    invalid_input, one line each: place, name, and which object is in the way; and their count
[[nodiscard]] Result<Done> check_sensors(const Scene& scene, const FinalGather& gather,
                                         std::span<const Sensor> sensors);

/// What each sensor receives, on the threads of `execution`.
///
/// Contract  check_sensors() lets them pass
/// Accuracy  as FinalGather::irradiance()
/// Order     the same bits with any number of threads
/// Errors    ErrorCode::stopped
[[nodiscard]] Result<std::vector<Gathered>> measure(const FinalGather& gather, const RadiosityField& field,
                                                    std::span<const Sensor> sensors, const Execution& execution);

/// What two meshes say together, the first with twice as many elements along every edge.
///
///     H = H_fine + (H_fine − H_coarse)/3                                          Richardson, for errors of the order h²
///
/// Returns   H, at least 0, with 5/3 and 1/3 of the bounds added; `discretisation` is |H_fine − H_coarse|/3, an estimate of what
///           H_fine lacks: a hopeful one where light and shadow meet inside of elements, no bound
struct Extrapolated {
  Rgb irradiance, bound, discretisation;
};
[[nodiscard]] Extrapolated extrapolated(const Gathered& fine, const Gathered& coarse);

}  // namespace etendue
