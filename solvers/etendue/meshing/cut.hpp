// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "etendue/geometry/polygon.hpp"

namespace etendue {

struct Segment {
  Vec3 from, to;
};

/// A part of a polygon that was cut, or the whole of one that was not.
struct CutPiece {
  Polygon polygon;
  std::size_t of = 0;  ///< index of the polygon it is a part of
};

/// Cuts the convex polygons of one plane along segments in it.                                     @eq IU.6.5.1
///
/// A polygon is cut when a segment runs through its inside, straight on from side to side: a segment that ends within a
/// polygon is extended to its border, and not into the next one. So all pieces are convex, and no segment passes the
/// inside of any. For lines through a whole plane, give segments that leave it.
///
/// Symbols   normal: of the plane, for all polygons the same, so that neighbours compute the same; touching [length]
/// Contract  normal is a unit vector; polygons are convex; touching > 0 and far above the rounding of coordinates
/// Returns   the pieces, those of a polygon one after the other in its place, with its winding; their areas sum to its
///           own up to rounding. Segments are taken in their order
/// Accuracy  a corner nearer than `touching` to a segment's line counts as on it: no piece is thinner than that, and a
///           segment that runs along a side cuts nothing. Where two polygons share a side (the same doubles) that a
///           segment crosses, both get the same new corner, to the last bit
/// Errors    none: a cut whose pieces would be too narrow for polygons is not made
[[nodiscard]] std::vector<CutPiece> cut_along(std::span<const Polygon> polygons, const Vec3& normal,
                                              std::span<const Segment> segments, double touching);

}  // namespace etendue
