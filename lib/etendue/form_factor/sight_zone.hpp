// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/form_factor/blocker.hpp"
#include "etendue/form_factor/facing_pair.hpp"

namespace etendue {

/// A corner loop whose edges, seen from a zone of the source, bound a convex region: counter-clockwise so that a × b
/// points into the cone over an edge from a to b.
using Outline = std::vector<Vec3>;

/// A convex part of the source from whose every point each blocker shows the same outline.
///
/// Coordinates are the source's own: x and y in its plane, z along its normal; lengths in the pair's scale.
struct SightZone {
  std::vector<Vec2> corners;  ///< counter-clockwise
  std::vector<Outline>
      outlines;       ///< of the blockers that may hide something; all wholly in front of source and receiver
  bool dark = false;  ///< inside or right under a solid: nothing is seen
};

/// A pair in the source's coordinates, cut into zones.
struct SightSpace {
  std::vector<Vec3> receiver;  ///< clockwise as seen from the source, as a front is
  std::vector<SightZone> zones;
};

/// Moves a pair and what stands between them into the source's frame: keeps of each blocker what lies in front of both
/// planes, and of a solid the silhouette. Since every outline lies before the receiver's plane, what is inside its cone
/// is hidden: no blocker's own plane is needed.
///
/// Symbols   from_origin the point around which the pair was localised
/// Rounding  a corner within kOnPlane of a plane counts as on it; a plate all of whose corners are hides nothing
[[nodiscard]] SightSpace sight_space(const FacingPair& pair, const Vec3& from_origin,
                                     std::span<const Blocker* const> blockers);

/// The same for a point instead of a source, at the origin of the frame: one zone without corners. The receiver is cut
/// at the point's horizon.
[[nodiscard]] SightSpace sight_space(const Vec3& point, const Vec3& normal, const Polygon& to,
                                     std::span<const Blocker* const> blockers);

/// The frame of a point with a unit normal: itself the origin, the normal along z.
struct PointFrame {
  Vec3 x, y, z;
  Vec3 origin;
  Vec3 placed(const Vec3& p) const { return {x.dot(p - origin), y.dot(p - origin), z.dot(p - origin)}; }
};
[[nodiscard]] PointFrame frame_of(const Vec3& point, const Vec3& normal);

/// The outlines of each blocker above the point's horizon, in its frame: for receivers beyond all of the blocker, whose
/// planes need not be known.
///
/// Domain    the point inside of no solid
[[nodiscard]] std::vector<std::vector<Outline>> point_outlines(const PointFrame& frame,
                                                               std::span<const Blocker* const> blockers);

}  // namespace etendue
