// SPDX-License-Identifier: Apache-2.0
#include "etendue/gather/sensors.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

std::vector<Sensor> sensor_grid(const std::string& name, const Vec3& origin, const Vec3& first, const Vec3& second,
                                int columns, int rows) {
  const Vec3 across = first.cross(second);
  require(columns >= 1 && rows >= 1, "sensor_grid: counts are at least 1");
  require(across.norm() > 0 && across.allFinite(), "sensor_grid: edges are neither zero nor parallel");
  std::vector<Sensor> sensors;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vec3 at = origin + (i + 0.5) / columns * first + (j + 0.5) / rows * second;
      sensors.push_back(
          {name + "[" + std::to_string(i + 1) + "," + std::to_string(j + 1) + "]", at, across.normalized()});
    }
  }
  return sensors;
}

Result<Done> check_sensors(const Scene& scene, const FinalGather& gather, std::span<const Sensor> sensors) {
  std::string text;
  std::size_t count = 0;
  for (const Sensor& sensor : sensors) {
    const auto obstacle = gather.obstacle(sensor.position, sensor.normal);
    if (!obstacle) continue;
    const std::string object = "'" + printable(scene.objects[obstacle->object].name) + "'";
    text += (sensor.place.empty() ? "" : sensor.place + ": ") + "sensor '" + printable(sensor.name) + "' ";
    switch (obstacle->kind) {
      case FinalGather::Obstacle::Kind::inside:
        text += "is inside of object " + object + ": nothing arrives there";
        break;
      case FinalGather::Obstacle::Kind::oblique:
        text += "lies on object " + object +
                ", but its normal is neither the surface's nor the opposite: lift it off the surface, or turn it";
        break;
      case FinalGather::Obstacle::Kind::facing_in:
        text += "lies on object " + object + " and faces into it: reverse its normal";
        break;
    }
    text += "\n";
    ++count;
  }
  if (count == 0) return Done{};
  return Error{ErrorCode::invalid_input, text + counted_errors(count)};
}

Result<std::vector<Gathered>> measure(const FinalGather& gather, const RadiosityField& field,
                                      std::span<const Sensor> sensors, const Execution& execution) {
  std::vector<Gathered> readings(sensors.size());
  const bool done = parallel_for(sensors.size(), execution, [&](std::size_t k) {
    readings[k] = gather.irradiance(sensors[k].position, sensors[k].normal, field);
  });
  if (!done) return Error{ErrorCode::stopped, "stopped before all sensors were read"};
  return readings;
}

Extrapolated extrapolated(const Gathered& fine, const Gathered& coarse) {
  const Rgb difference = (fine.irradiance - coarse.irradiance) / 3;
  const Rgb rounding = 8 * kUnitRoundoff * (fine.irradiance + coarse.irradiance);
  return {(fine.irradiance + difference).max(0.0), (4 * fine.bound + coarse.bound) / 3 + rounding, difference.abs()};
}

}  // namespace etendue
