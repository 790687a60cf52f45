// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/gather/sensors.hpp"

namespace etendue {

/// More sensors than this are refused.
inline constexpr std::size_t kMostSensors = std::size_t{1} << 20;

/// Sensors (docs/sensors.md): .json has named sensors and plane grids in a unit of its own; any other file is text, one
/// sensor a line, six numbers apart by commas, semicolons, blanks or tabs, in the scene's unit:
///
///     x, y, z, normal_x, normal_y, normal_z            # what follows is a comment
///
/// @param metres_per_unit of the scene
/// Returns   positions in scene units, unit normals; each sensor with its place in the file
/// Errors    input_output as read_file(); invalid_input, one line each with its place: what is not six finite numbers, a normal
///           of length zero, edges of a grid that are parallel, unknown or missing keys, no sensor at all; and their count
[[nodiscard]] Result<std::vector<Sensor>> read_sensors(const std::filesystem::path& path, double metres_per_unit);

/// What a sensor was found to receive.
struct SensorResult {
  Rgb irradiance = Rgb::Zero();            ///< [W/m²]
  Rgb bound = Rgb::Zero();                 ///< of the discrete equation and rounding [W/m²]
  std::optional<Rgb> discretisation = {};  ///< estimate [W/m²], where one was made
};

/// One line a sensor after a header: index, name (quoted, printable), position, normal, irradiance, bound and discretisation
/// per channel (empty where there is none), illuminance [lx]. Digits as many as read as the same double.
/// @param efficacy [lm/W]
[[nodiscard]] std::string sensors_csv(std::span<const Sensor> sensors, std::span<const SensorResult> results,
                                      double efficacy);

}  // namespace etendue
