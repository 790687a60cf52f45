// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// A closed polygonal loop in coordinates of its own, with what the form-factor integrals need of it.
struct Loop {
  std::vector<Vec3> vertices;
  Vec3 normal = Vec3::UnitZ();  ///< unit; the loop runs counter-clockwise around it
  double area = 0;
  double flatness = 0;  ///< largest distance of a vertex from the plane through the first, rounding included
};

/// Newell's normal and area of the vertices as they are.
[[nodiscard]] Loop make_loop(std::vector<Vec3> vertices);

/// Signed distance of `point` from the plane of `loop`; positive in front.
[[nodiscard]] inline double height_above(const Loop& loop, const Vec3& point) {
  return (point - loop.vertices.front()).dot(loop.normal);
}

/// A bound on the rounding error of height_above() for the points of `loop`, and on how far its vertices leave its
/// plane.
[[nodiscard]] double height_error(const Loop& plane, const Vec3& point);

[[nodiscard]] Vec3 mean(std::span<const Vec3> points);

/// Largest distance of a point from their mean.
[[nodiscard]] double radius(std::span<const Vec3> points);

/// A lower bound on the distance between two flat loops, the second moved by `offset`: from enclosing balls, and from
/// the heights of either above the plane of the other. 0 where none of them says more.
[[nodiscard]] double least_distance(const Loop& first, const Loop& second, const Vec3& offset);

/// The vertices of `loop` with heights above `threshold`; empty where nothing of positive extent is left.
/// A concave loop may come back with edges along the plane that run to and fro: line integrals do not see them.
///
/// Symbols   heights signed distances of the loop's vertices from the cutting plane [length]
/// Accuracy  a new vertex is off its edge by a few units in the last place of the edge's ends
/// Source    Sutherland and Hodgman 1974
[[nodiscard]] std::vector<Vec3> clip(std::span<const Vec3> loop, std::span<const double> heights);

}  // namespace etendue
