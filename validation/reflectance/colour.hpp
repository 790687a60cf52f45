// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

// Colours as the tests of reflectance compare them.
namespace etendue::validation {

using Rgb = Eigen::Array3d;

/// Largest difference of a channel.
inline double difference(const Rgb& a, const Rgb& b) {
  return (a - b).abs().maxCoeff();
}

}  // namespace etendue::validation
