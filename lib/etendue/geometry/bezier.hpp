// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// A bicubic Bézier surface  P(u, v) = Σ_ij B_i(u) B_j(v) control[i][j],  B_i(u) = C(3, i) uⁱ (1 − u)³⁻ⁱ, u, v in [0, 1].
struct BezierSurface {
  std::array<std::array<Vec3, 4>, 4> control;
};

/// What a point of the surface and its derivatives are.
struct BezierPoint {
  Vec3 point, along_u, along_v;
};
/// Accuracy  each coordinate within 16 u of the largest control coordinate (its derivatives: 64 u)
[[nodiscard]] BezierPoint at(const BezierSurface& surface, double u, double v);

/// Nearest meeting of a ray with a bicubic surface.                                                         @eq IU.5.0
///
/// The surface, seen along the ray, is a map of (u, v) onto the plane across the ray; what hits is sent to 0. Pieces
/// whose control points all lie aside are left out; those whose derivatives, after the inverse of the middle one, stay
/// within ½ of the identity have at most one hit, which Newton's iteration finds; all others are quartered.
///
/// Domain    finite control points; lengths between 2^-120 and 2^120
/// Returns   the smallest t with max(0, t_min) < t < t_max; normal along P_u × P_v, never flipped to the ray; uv: the
///           parameters
/// Hits      within kBezierEdge of the boundary in u and v as well, so that neighbours with a common boundary leave no
///           gap. A ray within a flat piece (to 2^-50 of its size) is a miss. An origin on the surface is not hit at t = 0 to point_error
/// Accuracy  point_error is a proved bound: of the piece's size where it was not yet simple after pieces of 2^-40 of the
///           surface (tangents, points where P_u × P_v = 0), else a few u of coordinates and size. No tessellation
/// Errors    ContractViolation where the ray or a control point is not finite or the direction zero
/// Source    the pieces: Toth 1985, On Ray Tracing Parametric Surfaces, doi 10.1145/325165.325233; NOTES.md §11
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const BezierSurface& surface);

/// How far beyond [0, 1] a parameter still counts as the boundary.
inline constexpr double kBezierEdge = 0x1p-40;

}  // namespace etendue
