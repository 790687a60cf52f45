// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/plane.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/ray.hpp"
#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/triangle.hpp"

namespace etendue {

/// What settled a decision.
enum class Tier {
  intervals,  ///< every sign was certain in outward-rounded doubles
  integers,   ///< at least one was not: all were found anew from whole numbers
};

struct Decision {
  bool hit = false;
  Tier tier = Tier::intervals;
};

/// Does a ray meet a shape, for what the stored doubles say to the last bit?
///
/// intersect() decides spheres and planes exactly too, but within lengths from 2^-200 to 2^200 only, and triangles and
/// polygons for corners moved by kTriangleShift. Here nothing is moved and nothing over- or underflows: for meshes that
/// have to agree with exact kernels, and as a judge. intersect() is faster: five times where signs are certain in
/// doubles, forty where they are not (triangles, measured).
///
/// Domain    any finite doubles, denormal ones included; sphere: radius > 0
/// Returns   hit where max(0, t_min) < t < t_max for a meeting. Sphere: a tangent is a miss. Plane: parallel is a miss.
///           Triangle: edges and corners belong to it; without area, or in a plane that the ray runs in or parallel to,
///           a miss. Polygon: the ray's line passes through it (Jordan test across the ray, so that of two polygons
///           beside one another exactly one has the common edge), and meets the stored plane within the range
/// Accuracy  exact, proved: both tiers evaluate the same polynomials, in Interval, then in Integer after scaling the
///           direction, the lengths and t by powers of two, which no sign depends on
/// Errors    ContractViolation where something is not finite, the direction zero, the radius not positive
[[nodiscard]] Decision decide_exactly(const Ray& ray, const Sphere& sphere);
[[nodiscard]] Decision decide_exactly(const Ray& ray, const Plane& plane);
[[nodiscard]] Decision decide_exactly(const Ray& ray, const Triangle& triangle);
[[nodiscard]] Decision decide_exactly(const Ray& ray, const Polygon& polygon);

}  // namespace etendue
