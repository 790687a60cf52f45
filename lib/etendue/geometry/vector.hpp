// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Vectors are Eigen's. Points and directions share the type; names tell which is meant.
using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace etendue
