// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// A box: centre, three orthonormal axes (the columns of `axes`, right-handed) and half the edge along each.
struct Box {
  Vec3 centre;
  Mat3 axes = Mat3::Identity();
  Vec3 half_edges;
};

/// Where a ray enters a closed box, or leaves it if it starts inside.                                      @eq IU.5.0
///
/// Domain    lengths between 2^-200 and 2^200; half edges > 0. The slabs are those of the stored doubles: axes that are
///           orthonormal to rounding give a box that is as right-angled
/// Returns   t with max(0, t_min) < t < t_max; the normal of the face, outward also for hits from inside; uv: offset
///           from the face's centre along the next two axes in cyclic order, in half edges, so in [−1, 1]²
/// Hits      faces, edges and corners belong to the box, so a ray in a face hits where it enters it; an origin on
///           a face is not hit at t = 0
/// Accuracy  t within kPlaneUlps; signs exact, and so are the order of the slabs up to 2^-56 of t: proved
/// Errors    ContractViolation where a half edge is not positive, or the direction zero or not finite
/// Source    Kay and Kajiya 1986
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Box& box);

}  // namespace etendue
