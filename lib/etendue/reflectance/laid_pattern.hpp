// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "etendue/reflectance/mapping.hpp"

namespace etendue {

/// Where a point of a surface lies in a pattern, and how that changes as the point moves along the surface.
struct PatternPlace {
  PatternPoint at;
  Vec3 u_slope = Vec3::Zero();  ///< gradient of u [1/length]; only its part along the surface counts
  Vec3 v_slope = Vec3::Zero();  ///< … of v
};

/// A pattern laid on a plane: once on width × height, from `origin` on along T_e and T_p × T_e.
struct LaidOnPlane {
  Vec3 origin = Vec3::Zero();
  PatternFrame frame;
  double width = 1, height = 1;
};
/// … around a cylinder, once from `origin` on to `height` along T_p.
struct LaidOnCylinder {
  Vec3 origin = Vec3::Zero();
  PatternFrame frame;
  double height = 1;
};
/// … around a sphere about `centre`: every point is mapped by its direction from there.
struct LaidOnSphere {
  Vec3 centre = Vec3::Zero();
  PatternFrame frame;
};
/// … once on each face of a box about `centre`, edges along T_e, T_p × T_e and T_p.
struct LaidOnBox {
  Vec3 centre = Vec3::Zero();
  PatternFrame frame;
  Vec3 edges = Vec3::Ones();
};
using LaidPattern = std::variant<LaidOnPlane, LaidOnCylinder, LaidOnSphere, LaidOnBox>;

/// plane_mapping(), cylinder_mapping(), sphere_mapping() and box_mapping(), and their gradients.             @eq IU.4-1
///
/// Domain    finite points. On an axis or in a middle, where a mapping has no value, u = 0, and what has no gradient has none
/// Accuracy  as those; slopes within 32 u of their length, measured
[[nodiscard]] PatternPlace place_in(const LaidPattern& pattern, const Vec3& point);

/// Gradients of s and t where the point is s first + t second on a plane: two vectors along it.
struct PlaneSlopes {
  Vec3 first, second;
};
/// Domain    first and second not parallel; if they are, both slopes are zero
[[nodiscard]] PlaneSlopes plane_slopes(const Vec3& first, const Vec3& second);

/// Gradient of the share of a turn around a unit axis, at x from a point of the axis; zero on it.
[[nodiscard]] Vec3 turn_slope(const Vec3& axis, const Vec3& x);

}  // namespace etendue
