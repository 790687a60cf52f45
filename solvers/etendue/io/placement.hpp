// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/io/scene_node.hpp"

namespace etendue {

/// Where a part of the scene stands: world = linear · local + offset. Never mirrors (determinant > 0).
struct Placement {
  Mat3 linear = Mat3::Identity();
  Vec3 offset = Vec3::Zero();
  bool keeps_shape = true;  ///< rotations and uniform scales only: spheres stay spheres
  double scale = 1;         ///< of lengths, where keeps_shape

  Vec3 point(const Vec3& local) const { return linear * local + offset; }
  Vec3 vector(const Vec3& local) const { return linear * local; }
  Vec3 normal(const Vec3& local) const;  ///< unit; normals are mapped by the inverse transpose
};

/// First `inner`, then `outer`.
[[nodiscard]] Placement compose(const Placement& outer, const Placement& inner);

[[nodiscard]] Placement uniform_scale(double factor);

/// Rotation about an axis (unit vector) through the origin, right-handed; exact for multiples of 90° about a coordinate
/// axis.
[[nodiscard]] Mat3 rotation(const Vec3& axis, double angle_deg);

/// Reads a "transform": an array of {translate}, {rotate} and {scale}, applied in the order in which they stand.
/// What is wrong is reported, and counts as no transform.
[[nodiscard]] Placement read_transform(const SceneNode& node);

}  // namespace etendue
