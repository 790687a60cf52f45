// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Half-line r(t) = origin + t · direction, restricted to t_min < t < t_max.                       @eq IU.5-1, RT.2
/// `direction` is a finite vector other than zero; t counts in units of its length, and is a distance when it is a
/// unit vector. Points are ordered along the ray as their t; t < 0 lies behind the origin and is never a hit.
struct Ray {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
  double time = 0;  ///< when it travels, for shapes that move

  Vec3 at(double t) const { return origin + t * direction; }
};

}  // namespace etendue
