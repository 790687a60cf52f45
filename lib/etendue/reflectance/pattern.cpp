// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/geometry/meeting.hpp"
#include "etendue/reflectance/noise.hpp"

namespace etendue {

namespace {

constexpr double kCrooked = 0.25;  // of a ring's width: how far rings leave the circle
constexpr double kBendsAlong = 7.0 / 16, kLobes = 3;

double share(const Checkerboard& board, const Vec3& point) {
  const Vec3 from = point - board.origin;
  const double sum = std::floor(board.u.dot(from) / board.size) + std::floor(board.v.dot(from) / board.size);
  return sum - 2 * std::floor(sum / 2);
}

double share(const Wood& wood, const Vec3& point) {
  const Vec3 from = point - wood.origin;
  const double height = wood.axis.dot(from);
  const Vec3 out = from - height * wood.axis;
  const TangentFrame frame = tangent_frame(wood.axis);
  const double around = std::atan2(frame.v.dot(out), frame.u.dot(out));
  const double bend = std::sin(kBendsAlong * height / wood.ring) + std::sin(kLobes * around);
  const double rings = out.norm() / wood.ring + kCrooked * bend;
  const double within = rings - std::floor(rings);
  return within * within;
}

double share(const Noise& noise, const Vec3& point) {
  return std::clamp(0.5 + fractal_noise((point - noise.origin) / noise.size, noise.octaves, noise.seed), 0.0, 1.0);
}

double share(const Marble& marble, const Vec3& point) {
  const Vec3 from = (point - marble.origin) / marble.size;
  double layers = marble.axis.dot(from);
  if (marble.turbulence != 0) layers += marble.turbulence * fractal_noise(from, marble.octaves, marble.seed);
  const double vein = 0.5 + 0.5 * std::cos(2 * std::numbers::pi * (layers - std::floor(layers)));
  return vein * vein * vein * vein;
}

}  // namespace

double second_share(const Pattern& pattern, const Vec3& point) {
  return std::visit([&](const auto& each) { return share(each, point); }, pattern);
}

}  // namespace etendue
