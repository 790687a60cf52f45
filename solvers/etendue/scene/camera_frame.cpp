// SPDX-License-Identifier: Apache-2.0
#include "etendue/scene/camera_frame.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace etendue {

namespace {

std::string text(const Vec3& v) {
  std::ostringstream out;
  out << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
  return out.str();
}

Error invalid(const std::string& message) {
  return {ErrorCode::invalid_input, "camera: " + message};
}

bool usable_direction(const Vec3& v) {
  return v.allFinite() && v.stableNorm() > 0;
}

}  // namespace

Result<CameraFrame> camera_frame(const Camera& camera) {
  if (!camera.eye.allFinite()) return invalid("eye " + text(camera.eye) + " is not finite");
  if (!usable_direction(camera.gaze)) return invalid("gaze " + text(camera.gaze) + " is not a direction");
  if (!usable_direction(camera.up)) return invalid("up " + text(camera.up) + " is not a direction");
  const double theta = camera.horizontal_half_angle;
  if (!(theta > 0 && theta < std::numbers::pi / 2)) {
    return invalid("horizontal half angle " + std::to_string(theta) + " rad is not between 0 and π/2");
  }
  if (camera.columns < 1 || camera.rows < 1) {
    return invalid("resolution " + std::to_string(camera.columns) + " × " + std::to_string(camera.rows) +
                   " has no pixel");
  }
  CameraFrame frame;
  frame.eye = camera.eye;
  frame.forward = camera.gaze.stableNormalized();
  const Vec3 right = frame.forward.cross(camera.up.stableNormalized());
  if (!(right.norm() >= kSmallestUpSine)) {
    return invalid("gaze " + text(camera.gaze) + " and up " + text(camera.up) + " are parallel; choose another up");
  }
  frame.right = right.normalized();
  frame.up = frame.right.cross(frame.forward).normalized();
  frame.tan_horizontal = std::tan(theta);
  frame.tan_vertical = frame.tan_horizontal * camera.rows / camera.columns;
  return frame;
}

}  // namespace etendue
