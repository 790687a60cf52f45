// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// How two coplanar polygons that face the same way stand to one another.
enum class Overlap { none, same, first_inside, second_inside, partial };

/// An overlap smaller than this share of the smaller polygon is the rounding of coordinates with five digits.
inline constexpr double kLeastOverlap = 0x1p-16;

/// Accuracy  coplanar: no vertex is off the other's plane by more than `slack` [length]
/// Domain    convex polygons
[[nodiscard]] Overlap overlap(const Polygon& first, const Polygon& second, double slack);

struct Overlapping {
  std::size_t first, second;
  Overlap how;
};
/// All pairs that overlap: a surface must not be there twice. Opposite sides of one plate do not overlap.
[[nodiscard]] std::vector<Overlapping> overlapping(std::span<const Polygon> polygons, double slack);

/// "lies on", "lies inside" … of the second polygon towards the first.
[[nodiscard]] std::string described(Overlap how);

/// Refuses objects of which faces overlap: light would leave the same place twice, and rows sum to more than one.
///
/// Errors    invalid_input, one line for each pair of objects: the second one's place in the file, both names, and how
///           they lie; and their count
[[nodiscard]] Result<Done> check_overlaps(const Scene& scene, const ElementMesh& mesh);

/// Beyond this share of its extent a polygon is refused as not flat; below, but above kPlanarity, its vertices are moved
/// onto its plane and the reader says so. It is what View3D takes for an error.
inline constexpr double kFlatEnough = 3e-5;

/// A polygon whose coordinates were written with few digits: made flat where that moves no vertex by more than
/// kFlatEnough of its extent.
struct FlatPolygon {
  Polygon polygon;
  double moved = 0;  ///< largest distance that a vertex was moved [length]
};
[[nodiscard]] Result<FlatPolygon> flattened(std::vector<Vec3> vertices);

/// Convex polygons that make up a simple one: itself, or triangles.
[[nodiscard]] std::vector<Polygon> convex_parts(const Polygon& polygon);

}  // namespace etendue
