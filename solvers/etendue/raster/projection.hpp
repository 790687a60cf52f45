// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "etendue/raster/gouraud.hpp"
#include "etendue/scene/camera_frame.hpp"

namespace etendue {

/// A corner in the frame of the camera, and a value that is linear on the surface.
struct SeenCorner {
  Vec3 place;  ///< right, up, forward
  Eigen::Array3d value;
};

/// Triangles in space onto a picture of columns × rows.                                            @eq IU.5.2
///
/// What is nearer than `near` is cut off, and what lies more than half a picture beyond an edge: the projection divides by
/// depth, and scan() has a largest coordinate. Cuts of an edge are the same bits from both triangles that share it.
/// Domain    near > 0; twice the columns and rows at most kLargestCoordinate
class Projection {
 public:
  Projection(const CameraFrame& frame, int columns, int rows, double near);

  [[nodiscard]] SeenCorner seen(const Vec3& point, const Eigen::Array3d& value) const;
  /// What is left of a triangle, as triangles: none, itself, or a fan. Into `triangles`, whose memory is used again.
  void project(const std::array<SeenCorner, 3>& triangle, std::vector<std::array<GouraudVertex, 3>>& triangles) const;

 private:
  GouraudVertex projected(const SeenCorner& corner) const;

  CameraFrame frame_;
  int columns_, rows_;
  double near_;
};

}  // namespace etendue
