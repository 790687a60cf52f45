// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/geometry/double_double3.hpp"
#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

// What the intersections share; their users want plane.hpp, sphere.hpp, ...
namespace etendue {

/// Whether the ray looks at t: max(0, t_min) < t < t_max.
inline bool looks_at(const Ray& ray, double t) {
  return t > 0 && t > ray.t_min && t < ray.t_max;
}

/// Refuses a direction that is zero or not finite, and an origin that is not finite.
void require_direction(const Ray& ray);

/// Parameter at which the ray meets the plane through `point` with this normal (any length): −(d + N·O)/(N·D).
///                                                                                        @eq IU.5-12, IU.5-13
/// Returns   t with max(0, t_min) < t < t_max; none where the ray is parallel to the plane or lies in it
/// Accuracy  relative error at most kMeetingError, proved; parallel, before and behind are decided exactly
[[nodiscard]] std::optional<DoubleDouble> meet_plane(const Ray& ray, const Vec3& normal, const Vec3& point);

/// The same for the whole line: t of any sign, whatever the ray's range.
[[nodiscard]] std::optional<DoubleDouble> line_meets_plane(const Ray& ray, const Vec3& normal, const Vec3& point);

/// The hit of a flat shape: point = O + tD, rounded once a component; its error bounds.
[[nodiscard]] Hit flat_hit(const Ray& ray, const DoubleDouble& t, const Vec3& normal);

/// Two unit vectors that make a right-handed frame with the unit vector `normal`: u × v = normal.
/// Source    Duff et al. 2017, Building an Orthonormal Basis, Revisited
struct TangentFrame {
  Vec3 u, v;
};
[[nodiscard]] TangentFrame tangent_frame(const Vec3& normal);

/// How far |N|² of a normal that counts as a unit vector may be from 1: twice what normalising a vector leaves, 4 u for
/// its length, once more for products of two of them.
inline constexpr double kUnitNormal = 0x1p-49;

[[nodiscard]] inline bool is_unit_normal(const Vec3& normal) {
  return std::abs(normal.squaredNorm() - 1) <= kUnitNormal;
}

}  // namespace etendue
