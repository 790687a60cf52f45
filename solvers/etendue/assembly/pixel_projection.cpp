// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/pixel_projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "etendue/geometry/meeting.hpp"

namespace etendue {

namespace {

std::vector<PixelView> hemicube_views(const Vec3& eye, const Vec3& u, const Vec3& v, const Vec3& normal, int n) {
  const double pixel = 2.0 / n;
  std::vector<PixelView> views{{eye, u, v, normal, n, n, -1, -1, pixel, ViewOutline::rectangle}};
  for (const Vec3& gaze : {u, v, Vec3(-u), Vec3(-v)}) {
    views.push_back({eye, normal.cross(gaze), normal, gaze, n, n / 2, -1, 0, pixel, ViewOutline::rectangle});
  }
  return views;
}

/// The axes of the cube whose diagonal is the normal: n/√3 + √(2/3) (cos 2πk/3 u + sin 2πk/3 v).
std::vector<PixelView> corner_views(const Vec3& eye, const Vec3& u, const Vec3& v, const Vec3& normal, int n) {
  const double along = 1 / std::numbers::sqrt3, across = std::sqrt(2.0 / 3.0);
  const std::array<Vec3, 3> axes{along * normal + across * u,
                                 along * normal + across * (-0.5 * u + 0.5 * std::numbers::sqrt3 * v),
                                 along * normal + across * (-0.5 * u - 0.5 * std::numbers::sqrt3 * v)};
  std::vector<PixelView> views;
  for (std::size_t k = 0; k < 3; ++k) {
    views.push_back(
        {eye, axes[(k + 1) % 3], axes[(k + 2) % 3], axes[k], n, n, -2, -2, 3.0 / n, ViewOutline::upper_triangle});
  }
  return views;
}

}  // namespace

PixelProjection::PixelProjection(PixelBody body, int resolution) : body_(body), resolution_(resolution) {
  if (body == PixelBody::hemicube) {
    cube_.emplace(resolution);
    largest_ = cube_->top(resolution / 2, resolution / 2);
  } else {
    corner_.emplace(resolution);
    for (int i = resolution / 2; i < resolution; ++i) {
      for (int j = resolution - 1 - i; j <= i; ++j) largest_ = std::max(largest_, corner_->at(i, j));
    }
  }
}

std::vector<PixelView> PixelProjection::views(const Vec3& eye, const Vec3& normal, double turn) const {
  const TangentFrame frame = tangent_frame(normal);
  const Vec3 u = std::cos(turn) * frame.u + std::sin(turn) * frame.v;
  const Vec3 v = std::cos(turn) * frame.v - std::sin(turn) * frame.u;
  return body_ == PixelBody::hemicube ? hemicube_views(eye, u, v, normal, resolution_)
                                      : corner_views(eye, u, v, normal, resolution_);
}

}  // namespace etendue
