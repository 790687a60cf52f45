// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/geometry/aabb.hpp"
#include "etendue/geometry/sight.hpp"

namespace etendue {

/// What a ray is tested against: a shape of the scene, or one triangle of a mesh.
struct Surface {
  std::size_t object = 0;  ///< index into Scene::objects
  std::size_t part = 0;    ///< triangle of a mesh; 0 otherwise
};

/// All surfaces of a scene, ordered by object, then by part. That order decides between hits of equal t.
[[nodiscard]] std::vector<Surface> surfaces(const Scene& scene);

/// A shape that moves is met where it is at the ray's time.
/// Domain    ray.time in [0, camera.shutter]
[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Scene& scene, const Surface& surface);

/// What is known of it without: sight.hpp.
[[nodiscard]] Sight sight(const Ray& ray, const Scene& scene, const Surface& surface);

/// Box around the surface, all along its way while the shutter is open; nothing for a plane, which has no end.
[[nodiscard]] std::optional<Aabb> bounds(const Scene& scene, const Surface& surface);

/// Whether `a` comes before `b` along the ray; equal t go to the smaller object, then to the smaller part.
[[nodiscard]] bool precedes(const SceneHit& a, const SceneHit& b);

}  // namespace etendue
