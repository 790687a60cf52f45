// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "etendue/acceleration/wide_tree.hpp"
#include "etendue/geometry/shear.hpp"

namespace etendue {

inline constexpr float kFarthest = std::numeric_limits<float>::max();

/// Nearest number of single precision, none of them infinite; and those below and above.
[[nodiscard]] inline float to_single(double value) {
  constexpr double kLargest = static_cast<double>(kFarthest);
  return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}
[[nodiscard]] inline float rounded_down(double value) {
  const float single = to_single(value);
  if (!(static_cast<double>(single) > value)) return single;
  if (single == 0) return -std::numeric_limits<float>::denorm_min();
  // The number next to it, as std::nextafter says, without a call.
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(single) + (single > 0 ? -1U : 1U));
}
[[nodiscard]] inline float rounded_up(double value) {
  return -rounded_down(-value);
}

/// A ray as the boxes and corners of a WideTree see it: from its entry into the scene on, its largest component being 1.
/// Says "no" only where the ray surely misses: NOTES.md.
class SingleRay {
 public:
  SingleRay(const Ray& ray, const WideTree& tree);

  /// Upper bound, in the tree's units, on where hits up to t lie.
  [[nodiscard]] float until(double t) const {
    const double way = (t - start_) * speed_ * (1 + kDoubleMargin) + 2 * margin_;
    return way < static_cast<double>(kFarthest) ? rounded_up(way) : kFarthest;
  }

  /// Which boxes of the node the ray may enter before `last`, a bit each; and where.
  [[nodiscard]] unsigned entered(const WideTree::Node& node, float last,
                                 std::array<float, WideTree::kWidth>& where) const;

  /// Which triangles of a leaf the ray may pass through before `last`, a bit each.
  [[nodiscard]] unsigned passed(const WideTree::Corners& corners, float last) const;

  /// For who counts from a little before that entry, lest rounding put it behind a surface: where that is, in the tree's
  /// coordinates, the direction, and until() from there.
  [[nodiscard]] Vec3 behind_start() const { return start_place_ - 4 * margin_ * direction_; }
  [[nodiscard]] const Vec3& direction() const { return direction_; }
  /// How far coordinates of single precision may be off.
  [[nodiscard]] double margin() const { return margin_; }
  [[nodiscard]] float from_behind(double t) const { return rounded_up(static_cast<double>(until(t)) + 5 * margin_); }

  /// Of the sizes involved: NOTES.md.
  static constexpr double kSingleMargin = 0x1p-20;
  /// Of the coordinates: kTriangleShift and double's own roundings, as in RayBoxTest.
  static constexpr double kDoubleMargin = 0x1p-48;

 private:
  std::array<float, 3> origin_, inverse_;
  std::array<bool, 3> forward_;
  std::array<std::size_t, 3> axis_;  // of the shear: across, across, along
  float along_x_, along_y_, sense_;
  float room_;
  double start_ = 0, speed_ = 1, margin_ = 0;
  Vec3 start_place_, direction_;
};

}  // namespace etendue
