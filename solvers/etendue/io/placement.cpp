// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/placement.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

namespace etendue {

namespace {

/// Sine and cosine of an angle in degrees; exact at multiples of 90°, where sin(π) computed in radians is not 0.
struct SineCosine {
  double sine, cosine;
};

SineCosine sine_cosine(double angle_deg) {
  int quadrant = 0;
  const double rest = std::remquo(angle_deg, 90.0, &quadrant);  // exact, in [-45, 45]
  const double radians = rest * std::numbers::pi / 180;
  const double s = std::sin(radians), c = std::cos(radians);
  switch (quadrant & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// A scale outside is a slip; inside, chains of them stay far from overflow.
constexpr ValueRange kScale{1e-9, 1e9};

constexpr std::size_t kAnyCount = std::numeric_limits<std::size_t>::max();

Placement read_scale(const SceneNode& node) {
  Placement placement;
  if (node.json().kind == JsonValue::Kind::array) {
    const auto factors = node.vector(kScale);
    if (!factors) return placement;
    const double first = factors->x();
    if ((factors->array() == first).all()) return uniform_scale(first);
    placement.linear = factors->asDiagonal();
    placement.keeps_shape = false;
    return placement;
  }
  if (const auto factor = node.number(kScale)) return uniform_scale(*factor);
  return placement;
}

Placement read_rotation(const SceneNode& node) {
  Placement placement;
  if (!node.is(keys_of("rotation"))) return placement;
  const auto axis_node = node.member("axis"), angle_node = node.member("angle_deg");
  const auto axis = axis_node ? axis_node->direction() : std::nullopt;
  const auto angle = angle_node ? angle_node->number({-36000, 36000}) : std::nullopt;
  if (axis && angle) placement.linear = rotation(*axis, *angle);
  return placement;
}

Placement read_step(const SceneNode& node) {
  Placement placement;
  if (!node.is_object()) return placement;
  if (const auto shift = node.member("translate")) {
    if (node.is(keys_of("translate"))) placement.offset = shift->vector().value_or(Vec3::Zero());
    return placement;
  }
  if (const auto turn = node.member("rotate")) return node.is(keys_of("rotate")) ? read_rotation(*turn) : placement;
  if (const auto factor = node.member("scale")) return node.is(keys_of("scale")) ? read_scale(*factor) : placement;
  static const KeySet kSteps{"step", {}, {"translate", "rotate", "scale"}};
  if (node.json().members.empty()) {
    node.expected("one key \"translate\", \"rotate\" or \"scale\"");
  } else {
    (void)node.is(kSteps);  // reports each key, with the nearest of the three
  }
  return placement;
}

}  // namespace

Vec3 Placement::normal(const Vec3& local) const {
  return (linear.inverse().transpose() * local).stableNormalized();
}

Placement compose(const Placement& outer, const Placement& inner) {
  Placement both;
  both.linear = outer.linear * inner.linear;
  both.offset = outer.linear * inner.offset + outer.offset;
  both.keeps_shape = outer.keeps_shape && inner.keeps_shape;
  both.scale = outer.scale * inner.scale;
  return both;
}

Placement uniform_scale(double factor) {
  Placement placement;
  placement.linear = factor * Mat3::Identity();
  placement.scale = factor;
  return placement;
}

Mat3 rotation(const Vec3& axis, double angle_deg) {
  const auto [s, c] = sine_cosine(angle_deg);
  Mat3 cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return c * Mat3::Identity() + s * cross + (1 - c) * axis * axis.transpose();
}

Placement read_transform(const SceneNode& node) {
  Placement all;
  for (const SceneNode& step : node.items(1, kAnyCount, "steps")) all = compose(read_step(step), all);
  return all;
}

}  // namespace etendue
