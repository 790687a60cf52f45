// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/accelerator.hpp"

#include <algorithm>

#include "etendue/acceleration/bounding_spheres.hpp"
#include "etendue/acceleration/bounding_volumes.hpp"
#include "etendue/acceleration/brute_force.hpp"
#include "etendue/acceleration/embree.hpp"
#include "etendue/acceleration/grid.hpp"
#include "etendue/acceleration/octree.hpp"

namespace etendue {

Accelerator::Accelerator(const Scene& scene)
    : scene_(scene), transparent_(std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        return scene.materials[object.material].k_t > 0;
      })) {}

std::unique_ptr<const Accelerator> make_accelerator(const Scene& scene, AcceleratorKind kind) {
  switch (kind) {
    case AcceleratorKind::brute_force:
      return std::make_unique<const BruteForce>(scene);
    case AcceleratorKind::bounding_spheres:
      return std::make_unique<const BoundingSpheres>(scene);
    case AcceleratorKind::grid:
      return std::make_unique<const Grid>(scene);
    case AcceleratorKind::octree:
      return std::make_unique<const Octree>(scene);
    case AcceleratorKind::embree:
      return make_embree(scene);
    case AcceleratorKind::bounding_volumes:
      break;
  }
  return std::make_unique<const BoundingVolumes>(scene);
}

}  // namespace etendue
