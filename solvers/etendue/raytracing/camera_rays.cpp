// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/camera_rays.hpp"

#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"

namespace etendue {

PicturePoint picture_point(const Camera& camera, int column, int row, double across, double down) {
  require(column >= 0 && column < camera.columns && row >= 0 && row < camera.rows,
          "picture_point: the pixel is in the picture");
  const int j = camera.rows - 1 - row;
  return {(column + across) / camera.columns, (j + (1 - down)) / camera.rows};
}

namespace {

Vec3 towards_view_plane(const CameraFrame& frame, const PicturePoint& point) {
  return frame.forward + (2 * point.x - 1) * frame.tan_horizontal * frame.right +
         (2 * point.y - 1) * frame.tan_vertical * frame.up;
}

}  // namespace

Ray eye_ray(const CameraFrame& frame, const PicturePoint& point) {
  const Vec3 p = towards_view_plane(frame, point);
  Ray ray;
  ray.origin = frame.eye;
  ray.direction = p.normalized();
  return ray;
}

Ray sample_ray(const Camera& camera, const CameraFrame& frame, const PicturePoint& point, const SampleKey& key) {
  Ray ray = eye_ray(frame, point);
  if (camera.shutter > 0) ray.time = camera.shutter * key.spread(sample_number::kTime);
  if (camera.lens_radius > 0) {
    const auto [area, angle] = key.spread_pair(sample_number::kLensOut);
    const double out = camera.lens_radius * std::sqrt(area);
    const double turn = 2 * std::numbers::pi * angle;
    const Vec3 from = out * (std::cos(turn) * frame.right + std::sin(turn) * frame.up);
    ray.origin = frame.eye + from;
    ray.direction = (camera.focal_distance * towards_view_plane(frame, point) - from).normalized();
  }
  return ray;
}

ViewWindow view_window(const CameraFrame& frame, double distance) {
  require(distance > 0, "view_window: the view plane lies before the eye");
  const double half_width = distance * frame.tan_horizontal;
  const double half_height = distance * frame.tan_vertical;
  return {-half_width, half_width, -half_height, half_height, distance};
}

Ray window_ray(const CameraFrame& frame, const ViewWindow& window, const Camera& camera, int i, int j) {
  const double u = window.left + (window.right - window.left) * (i + 0.5) / camera.columns;
  const double v = window.bottom + (window.top - window.bottom) * (j + 0.5) / camera.rows;
  const Vec3 d = u * frame.right + v * frame.up + window.distance * frame.forward;
  Ray ray;
  ray.origin = frame.eye;
  ray.direction = d.normalized();
  return ray;
}

}  // namespace etendue
