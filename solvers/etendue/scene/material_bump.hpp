// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/vector.hpp"
#include "etendue/reflectance/relief.hpp"

namespace etendue {

/// Heights of which a surface is shaded as if it had them; its points stay where they are.             @eq IU.4.2.1
struct MaterialBump {
  /// Coordinates of a plane, for whatever shape stands across: u = (p − origin)·u / size, v likewise.
  struct Lay {
    Vec3 origin = Vec3::Zero();
    Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();  ///< unit vectors
    double size = 1;
  };
  ReliefKind relief;
  std::optional<Lay> lay;  ///< without: the shape's own coordinates, has_chart()
};

}  // namespace etendue
