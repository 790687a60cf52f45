// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Light that a surface returns of the general illumination, the same everywhere and in every direction.
///
///     I = k_a I_a                                                                            @eq IU.2-1, IU.2-4
///
/// Symbols   k_a coefficient of ambient reflection, in 2-1 the diffuse one, k_d; I_a ambient intensity; per channel
/// Accuracy  one rounding
[[nodiscard]] inline Eigen::Array3d ambient(const Eigen::Array3d& k_a, const Eigen::Array3d& intensity) {
  return k_a * intensity;
}

}  // namespace etendue
