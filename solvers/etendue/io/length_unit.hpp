// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace etendue {

/// A unit of length by the name that files and the command line give it.
struct LengthUnit {
  const char* name;
  double metres;
};
/// International yard and pound agreement, 1959, for the foot and the inch.
inline constexpr std::array<LengthUnit, 7> kLengthUnits{
    {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"um", 1e-6}, {"km", 1000}, {"ft", 0.3048}, {"in", 0.0254}}};

[[nodiscard]] inline std::vector<std::string> length_unit_names() {
  std::vector<std::string> names;
  for (const LengthUnit& unit : kLengthUnits) names.emplace_back(unit.name);
  return names;
}

[[nodiscard]] inline std::optional<double> metres_of(const std::string& unit_name) {
  for (const LengthUnit& unit : kLengthUnits) {
    if (unit_name == unit.name) return unit.metres;
  }
  return std::nullopt;
}

}  // namespace etendue
