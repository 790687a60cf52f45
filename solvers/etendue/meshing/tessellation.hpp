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
/// Returns   for meshes their own triangles, for polygons those of ears(), for quadrics quadric_net() of facets/2 cells, at most 64
/// Errors    infinite planes, which plane_before() has; the message names the object
[[nodiscard]] Result<Tessellation> tessellated(const Object& object, const TessellationOptions& options);

/// What of an infinite plane an eye can tell from the whole: a square around the eye's foot, 2^21 times as wide as the eye is
/// high. What it lacks is within 2^-20 of the horizon [rad], a twentieth of a pixel of pictures 2^16 wide.
/// Returns   two triangles; none where the eye lies in the plane
/// Accuracy  points between the corners to 2^-31 of the eye's height; a picture's corners are rounded besides (scan.hpp)
[[nodiscard]] Tessellation plane_before(const Plane& plane, const Vec3& eye);

}  // namespace etendue
