// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/geometry/double_double3.hpp"
#include "etendue/geometry/expansion.hpp"

namespace etendue {

/// Newell's sum Σ v_i × v_{i+1} over the closed chain of vertices: the normal times twice the area.          @eq G9
/// Needs no corner to be convex and no three vertices to span a plane.
///
/// Accuracy  each component within 2^-100 n d² of the exact sum, d the diameter; proved, NOTES.md §6
/// Source    Sutherland, Sproull and Schumacker 1974
[[nodiscard]] DoubleDouble3 newell_sum(const std::vector<Vec3>& vertices);

/// N · (point − v_0), N the exact Newell sum: the height of `point` over the polygon's plane times the length of N.
///
/// Accuracy  exact, for what double leaves open
/// Domain    as for Expansion
[[nodiscard]] Expansion exact_newell_height(const std::vector<Vec3>& vertices, const Vec3& point);

/// The index of the largest component of `normal`: dropping it projects with the largest area.      @eq IU.5.6.2
[[nodiscard]] int dominant_axis(const Vec3& normal);

/// `point` without its component `axis`; the order of the other two keeps the winding seen from the axis' tip.
[[nodiscard]] inline Vec2 projected(const Vec3& point, int axis) {
  return {point[(axis + 1) % 3], point[(axis + 2) % 3]};
}

}  // namespace etendue
