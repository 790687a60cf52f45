// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/shape_values.hpp"

#include <cmath>
#include <utility>

namespace etendue {

namespace {

/// Axes of a box that its transform has sheared have a cosine larger than the roundings of a chain of rotations leave:
/// each of up to some hundreds of products errs by a few 2^-53.
constexpr double kLargestAxisCosine = 0x1p-40;

/// Low and high corner of the box as written.
std::optional<std::pair<Vec3, Vec3>> read_corners(const SceneNode& node, const std::string& type) {
  const bool by_corners = node.member("low") || node.member("high");
  const bool by_centre = node.member("centre") || node.member("size");
  if (by_corners == by_centre || !node.member(by_corners ? "high" : "size") ||
      !node.member(by_corners ? "low" : "centre")) {
    node.complain("found a " + type +
                  " with other keys, expected either \"low\" and \"high\", or \"centre\" and \"size\"");
    for (const char* key : {"low", "high", "centre"}) (void)vector_of(node, key);
    (void)vector_of(node, "size", kPositive);
    return std::nullopt;
  }
  if (by_centre) {
    const auto centre = vector_of(node, "centre");
    const auto size = vector_of(node, "size", kPositive);
    if (!centre || !size) return std::nullopt;
    return std::pair<Vec3, Vec3>(*centre - *size / 2, *centre + *size / 2);
  }
  const auto low = vector_of(node, "low"), high = vector_of(node, "high");
  if (!low || !high) return std::nullopt;
  if (!(low->array() < high->array()).all()) {
    node.member("high")->complain(
        "found a coordinate that is not above that of \"low\", expected low < high on each axis");
    return std::nullopt;
  }
  return std::pair<Vec3, Vec3>(*low, *high);
}

}  // namespace

bool usable(const Vec3& v) {
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= kLargestNumber;
}
bool usable(double length) {
  return length > 0 && length <= kLargestNumber;
}

void complain_out_of_range(const SceneNode& node) {
  node.complain(
      "found a transform that moves the shape out of range, expected coordinates within ±1e+50 and lengths > 0");
}

std::optional<Vec3> vector_of(const SceneNode& node, const char* key, const ValueRange& interval) {
  const auto member = node.member(key);
  return member ? member->vector(interval) : std::nullopt;
}
std::optional<Vec3> direction_of(const SceneNode& node, const char* key) {
  const auto member = node.member(key);
  return member ? member->direction() : std::nullopt;
}
std::optional<double> length_of(const SceneNode& node, const char* key, const ValueRange& interval) {
  const auto member = node.member(key);
  return member ? member->number(interval) : std::nullopt;
}

bool stays_round(const SceneNode& node, const std::string& type, const Placement& placement) {
  if (placement.keeps_shape) return true;
  node.complain("found a scale that is not the same along all axes, expected one number for a " + type);
  return false;
}

std::optional<Box> read_placed_box(const SceneNode& node, const std::string& type, const Placement& placement) {
  const auto corners = read_corners(node, type);
  if (!corners) return std::nullopt;
  const auto& [low, high] = *corners;
  Box box;
  box.centre = placement.point((low + high) / 2);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 edge = placement.linear.col(axis);
    box.axes.col(axis) = edge.stableNormalized();
    box.half_edges[axis] = edge.stableNorm() * ((high[axis] - low[axis]) / 2);
  }
  if (!usable(box.centre) || !usable(box.half_edges) || !usable(box.half_edges.minCoeff()) || !box.axes.allFinite()) {
    complain_out_of_range(node);
    return std::nullopt;
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(box.axes.col(axis).dot(box.axes.col((axis + 1) % 3))) <= kLargestAxisCosine) continue;
    node.complain("found a transform that shears the " + type + ", expected right angles" +
                  (type == "box" ? " (or a mesh)" : ""));
    return std::nullopt;
  }
  return box;
}

}  // namespace etendue
