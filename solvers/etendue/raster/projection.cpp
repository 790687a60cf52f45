// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/projection.hpp"

#include <algorithm>

namespace etendue {

namespace {

constexpr double kMargin = 1.5;  // what is drawn beyond the picture's edge, where cuts cannot be seen

using Outline = std::vector<SeenCorner>;

/// A side of what is kept: distance = normal · place + offset ≥ 0.
struct Side {
  Vec3 normal;
  double offset;
  double distance(const SeenCorner& corner) const { return normal.dot(corner.place) + offset; }
};

// The part of a convex outline on the inner side. New corners are computed from the inner end of an
// edge to the outer one: the same bits from both triangles that share the edge.
Outline clipped(const Outline& outline, const Side& side) {
  Outline result;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const SeenCorner& a = outline[k];
    const SeenCorner& b = outline[(k + 1) % outline.size()];
    const double at_a = side.distance(a), at_b = side.distance(b);
    if (at_a >= 0) result.push_back(a);
    if ((at_a >= 0) == (at_b >= 0)) continue;
    const auto between = [](const SeenCorner& in, const SeenCorner& out, double at_in, double at_out) {
      const double t = at_in / (at_in - at_out);
      return SeenCorner{in.place + t * (out.place - in.place), in.value + t * (out.value - in.value)};
    };
    result.push_back(at_a >= 0 ? between(a, b, at_a, at_b) : between(b, a, at_b, at_a));
  }
  return result;
}

}  // namespace

Projection::Projection(const CameraFrame& frame, int columns, int rows, double near)
    : frame_(frame), columns_(columns), rows_(rows), near_(near) {}

SeenCorner Projection::seen(const Vec3& point, const Eigen::Array3d& value) const {
  const Vec3 d = point - frame_.eye;
  return {{d.dot(frame_.right), d.dot(frame_.up), d.dot(frame_.forward)}, value};
}

void Projection::project(const std::array<SeenCorner, 3>& triangle,
                         std::vector<std::array<GouraudVertex, 3>>& triangles) const {
  triangles.clear();
  const double h = kMargin * frame_.tan_horizontal, v = kMargin * frame_.tan_vertical;
  const std::array<Side, 5> sides{
      {{{0, 0, 1}, -near_}, {{-1, 0, h}, 0}, {{1, 0, h}, 0}, {{0, -1, v}, 0}, {{0, 1, v}, 0}}};
  bool whole = true;
  for (const Side& side : sides) {
    int outside = 0;
    for (const SeenCorner& corner : triangle) outside += !(side.distance(corner) >= 0);
    if (outside == 3) return;
    whole = whole && outside == 0;
  }
  if (whole) {
    triangles.push_back({projected(triangle[0]), projected(triangle[1]), projected(triangle[2])});
    return;
  }
  Outline outline(triangle.begin(), triangle.end());
  for (const Side& side : sides) outline = clipped(outline, side);
  for (std::size_t k = 2; k < outline.size(); ++k) {
    triangles.push_back({projected(outline[0]), projected(outline[k - 1]), projected(outline[k])});
  }
}

GouraudVertex Projection::projected(const SeenCorner& corner) const {
  const double x = (corner.place.x() / (corner.place.z() * frame_.tan_horizontal) + 1) / 2;
  const double y = (corner.place.y() / (corner.place.z() * frame_.tan_vertical) + 1) / 2;
  return {{x * columns_, (1 - y) * rows_}, 1 / corner.place.z(), corner.value};
}

}  // namespace etendue
