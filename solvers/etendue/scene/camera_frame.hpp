// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/result.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// Below this sine of the angle between gaze and up the picture's "up" is refused: normalising G × U would magnify the
/// roundings of the two directions (a few 2^-53) to more than 2^-12 of a turn of the picture about the gaze.
inline constexpr double kSmallestUpSine = 0x1p-40;

/// The viewing system of one camera, resolved: what both the ray generator and the projection start from.   @eq IU.5.2
///
///     X = G × U,  Y = X × G,  tan φ = tan θ · R_y / R_x
///
/// Symbols   G gaze, U up; X, Y, G stored as unit vectors, orthogonal (right, up, forward in the picture);
///           θ, φ half angles of the field of view; R_x, R_y columns and rows
/// A point E + w (G + s tan θ X + t tan φ Y) with w > 0 appears at x' = (s + 1)/2, y' = (t + 1)/2, both from the
/// bottom-left corner of the picture.
struct CameraFrame {
  Vec3 eye = Vec3::Zero();
  Vec3 right = Vec3::UnitX();    ///< X
  Vec3 up = Vec3::UnitZ();       ///< Y
  Vec3 forward = Vec3::UnitY();  ///< G
  double tan_horizontal = 1;     ///< tan θ
  double tan_vertical = 1;       ///< tan φ; the ratio R_y : R_x holds for the tangents, not for the angles
};

/// Errors    non-finite values, a zero gaze or up, gaze parallel to up (no picture plane: G × U = 0), θ outside
///           (0, π/2), fewer than one row or column; the message names the value
[[nodiscard]] Result<CameraFrame> camera_frame(const Camera& camera);

}  // namespace etendue
