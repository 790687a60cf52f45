// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// A place in a pattern: u along its first, v along its second direction, each a share of its size.         @eq IU.4-1
struct PatternPoint {
  double u = 0;
  double v = 0;
};

/// How a pattern is laid on a sphere, a cylinder or a plane: two orthogonal unit vectors.
struct PatternFrame {
  Vec3 pole = Vec3::UnitZ();     ///< T_p: from the centre towards the north pole; a cylinder's axis
  Vec3 equator = Vec3::UnitX();  ///< T_e: from the centre towards the equator's point of reference
};

/// Bound on the absolute error of u and v away from the poles; measured.
inline constexpr double kMappingError = 8 * kUnitRoundoff;

/// Inverse mapping of a sphere: longitude and latitude of a normal.
///
///     v = φ/π,   φ = ∠(−T_p, N)                                                                  @eq IU.4-2, IU.4-3
///     u = ∠(T_e, N about T_p)/2π, counted from T_e towards T_p × T_e                              @eq IU.4-4, IU.4-5
///
/// As mended: 1 − u, not u − 1, on the far side (E1); both angles by atan2, so that no argument of an arc cosine exceeds
/// one (G5)
/// Symbols   N unit normal of the sphere
/// Domain    unit vectors (kUnitTolerance), T_p·T_e = 0 within kUnitTolerance
/// Returns   u in [0, 1), from 0 at T_e around the equator; v in [0, 1], 0 at the south and 1 at the north pole; u = 0 at the poles
/// Accuracy  v: kMappingError; u: the same over sin φ. Measured
/// Errors    ContractViolation outside the domain
[[nodiscard]] PatternPoint sphere_mapping(const PatternFrame& frame, const Vec3& normal);

/// The normal whose sphere_mapping() is (u, v).
[[nodiscard]] Vec3 sphere_normal(const PatternFrame& frame, const PatternPoint& at);

/// Inverse mapping of a cylinder around T_p through the origin: u as for a sphere, v = T_p·p / height.      @eq IU.4-1
///
/// Domain    p not on the axis; height > 0 [length]
/// Errors    ContractViolation outside the domain
[[nodiscard]] PatternPoint cylinder_mapping(const PatternFrame& frame, const Vec3& point, double height);

/// Mapping of the plane across T_p: u = T_e·p / width, v = (T_p × T_e)·p / width.                           @eq IU.4-1
///
/// Domain    width > 0 [length]
/// Errors    ContractViolation outside the domain
[[nodiscard]] PatternPoint plane_mapping(const PatternFrame& frame, const Vec3& point, double width);

/// The six images around an object, as cameras at the middle of a cube would take them: each sees 90° both ways.
enum class CubeFace { right, left, back, front, top, bottom };  // +x, −x, +y, −y, +z, −z
inline constexpr std::array<CubeFace, 6> kCubeFaces{CubeFace::right, CubeFace::left, CubeFace::back,
                                                    CubeFace::front, CubeFace::top,  CubeFace::bottom};

/// Where such a camera looks, and what is right and up in its picture.
struct CubeView {
  Vec3 gaze, right, up;
};
[[nodiscard]] CubeView cube_view(CubeFace face);

/// A place in one of the images: u from its left to its right edge, v from its bottom to its top.
struct CubePoint {
  CubeFace face = CubeFace::right;
  PatternPoint at;
};

/// Where a direction leads to in the pattern of the surroundings.                                          @eq IU.4.1.3
///
///     the face of D's largest component;   u = ½ (1 + D·right / D·gaze),   v = ½ (1 + D·up / D·gaze)
///
/// Domain    a finite vector other than zero, of any length
/// Returns   u, v in [0, 1]. On an edge or a corner of the cube, where components are equally large, the first face in the
///           order of CubeFace; the others hold the same direction at their own edges
/// Accuracy  u, v within 2 u; the face exact. Proved: a quotient, a sum
/// Errors    ContractViolation outside the domain
[[nodiscard]] CubePoint cube_mapping(const Vec3& direction);

/// A vector (not of unit length) in the direction that a place in an image shows.
[[nodiscard]] Vec3 cube_direction(const CubePoint& point);

/// Mapping of a box around the origin: each face shows the whole pattern, upright on the four sides as seen from outside
/// with T_p up, on top and bottom with T_p × T_e up.                                                        @eq IU.4-1
///
///     q = (T_e·p, (T_p × T_e)·p, T_p·p) in half edges; the face of q's largest component, as cube_mapping() finds it;
///     u = ½ (1 + q·right / q·out),   v = ½ (1 + q·up / q·out)
///
/// Domain    edges > 0 [length]; p not the origin. On other surfaces than the box itself, which it is projected onto from the
///           middle, the pattern is continuous on each face
/// Errors    ContractViolation outside the domain
[[nodiscard]] CubePoint box_mapping(const PatternFrame& frame, const Vec3& point, const Vec3& edges);

/// What is right and up on a face as seen from outside; gaze points out of the box.
[[nodiscard]] CubeView outside_view(CubeFace face);

}  // namespace etendue
