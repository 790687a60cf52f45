// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "etendue/core/result.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// A shape as a net of triangles, wound so that they are seen from outside, and which of its edges are meant to be seen.
struct Tessellation {
  Mesh mesh;
  double crease_angle;                               ///< what corner_normals() takes [rad]
  std::vector<std::array<Vec2, 3>> parameters = {};  ///< u, v of each triangle's corners, as parameters() counts them
};

struct TessellationOptions {
  int facets = 48;  ///< around a sphere, cylinder, cone, disc, ring; half as many from pole to pole, around a tube
                    ///< and along each side of a Bézier surface
  double crease_angle = std::numbers::pi / 3;  ///< of meshes [rad]; curved shapes have no creases, boxes nothing but
};

inline constexpr int kFewestFacets = 3;
inline constexpr int kMostFacets = 4096;

/// The shape of an object in triangles, whose corners lie on it.
///
/// The parameters of a corner belong to its triangle: u of the last column of a closed net is 1, not 0; at a pole or an apex it
/// is that of the middle of the other side.                                                          @eq IU.4.1.2
/// Domain    facets in [kFewestFacets, kMostFacets]
/// Returns   for meshes their own triangles, for polygons the triangles that ears leave
/// Errors    infinite planes, quadrics and polygons with holes; the message names the object
[[nodiscard]] Result<Tessellation> tessellated(const Object& object, const TessellationOptions& options);

}  // namespace etendue
