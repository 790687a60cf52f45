// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/bezier.hpp"
#include "etendue/geometry/box.hpp"
#include "etendue/geometry/cone.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/mesh.hpp"
#include "etendue/geometry/plane.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/polygon_with_holes.hpp"
#include "etendue/geometry/quadric.hpp"
#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/torus.hpp"
#include "etendue/geometry/triangle.hpp"
#include "etendue/reflectance/laid_pattern.hpp"

namespace etendue {

/// Patterns on surfaces that are defined by parameters: these themselves, and their gradients.               @eq IU.4.1.2
///
///     sphere, cylinder, cone, torus, Bézier surface   u, v of Hit::uv: turns, height, parameters in [0, 1]
///     disc, box, quadric                              ½ (1 + each of Hit::uv): the square around, each face, the box's xy
///     polygon, triangle                               p = P_0 + u (P_1 − P_0) + v (P_last − P_0): a parallelogram is the unit square
///     plane                                           Hit::uv, in units of length
///     mesh                                            Mesh::texture between the corners of triangle `part`; without, its barycentrics
///
/// Domain    a hit of that shape, its point where the shape stands
/// Accuracy  u and v as the hits'; slopes within 64 u of their length, measured
[[nodiscard]] PatternPlace parameters(const Sphere& sphere, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Cylinder& cylinder, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Cone& cone, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Torus& torus, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const BezierSurface& surface, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Disc& disc, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Box& box, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Quadric& quadric, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Polygon& polygon, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const PolygonWithHoles& polygon, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Triangle& triangle, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Plane& plane, const Hit& hit, std::size_t part = 0);
[[nodiscard]] PatternPlace parameters(const Mesh& mesh, const Hit& hit, std::size_t part = 0);

/// Those of a point on a net over a shape: of a polygon's or a disc's plane, of a face of a box.
[[nodiscard]] PatternPlace parameters_on(const Polygon& polygon, const Vec3& point);
[[nodiscard]] PatternPlace parameters_on(const Disc& disc, const Vec3& point);
/// `axis` is the one that the face is across.
[[nodiscard]] PatternPlace parameters_on(const Box& box, Eigen::Index axis, const Vec3& point);

/// Between the corners of a triangle whose u and v are known, at barycentrics (β, γ).
[[nodiscard]] PatternPlace between(const Triangle& triangle, const std::array<Vec2, 3>& corners, const Vec2& at);

}  // namespace etendue
