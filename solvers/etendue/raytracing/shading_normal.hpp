// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/scene/scene.hpp"

namespace etendue {

/// Whether a shape has coordinates of its own that chart() knows.
[[nodiscard]] inline bool has_chart(const Shape& shape) {
  return std::holds_alternative<Sphere>(shape) || std::holds_alternative<Cylinder>(shape) ||
         std::holds_alternative<Cone>(shape) || std::holds_alternative<Torus>(shape);
}

/// The normal by which a surface with bumps is shaded: bumped_normal() of its heights.                     @eq IU.4.2.1
///
/// Symbols   point of the surface at time 0, at_rest(); outward its geometric unit normal, as Hit has it: heights stand on that side
/// Domain    a lay, or a shape with has_chart(); the point on the shape, or on a net of triangles over it
/// Returns   a unit vector less than 90° from `outward`
[[nodiscard]] Vec3 shading_normal(const MaterialBump& bump, const Shape& shape, const Vec3& point, const Vec3& outward);

}  // namespace etendue
