// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "etendue/core/floating_point.hpp"

namespace etendue {

// Three ways to bring intensities back to what a display can show, [0, 1]. Each leaves alone what already fits.

/// Limits each channel by itself: cheap, but colours shift, and where the limit sets in the slope jumps, which the eye
/// sees as a Mach band.                                                                             @eq IU.2.8
[[nodiscard]] Eigen::Array3d clamp(const Eigen::Array3d& rgb);

/// Divides every pixel by the largest channel of the whole image, if that exceeds one: keeps all ratios, so makes no
/// Mach bands; to be preferred.                                                                     @eq IU.2.8
/// Errors    ContractViolation if a value is negative or not finite
[[nodiscard]] std::vector<Eigen::Array3d> scale_image(std::span<const Eigen::Array3d> pixels);

/// Divides a pixel by its own largest channel, if that exceeds one: keeps its hue and saturation, changes its
/// brightness.                                                                                      @eq IU.2.9
/// Errors    ContractViolation if a value is negative or not finite
[[nodiscard]] Eigen::Array3d scale_pixel(const Eigen::Array3d& rgb);

}  // namespace etendue
