// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/accelerator.hpp"

#include "etendue/acceleration/bounding_spheres.hpp"
#include "etendue/acceleration/bounding_volumes.hpp"
#include "etendue/acceleration/brute_force.hpp"
#include "etendue/acceleration/grid.hpp"
#include "etendue/acceleration/octree.hpp"

namespace etendue {

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
    case AcceleratorKind::bounding_volumes:
      break;
  }
  return std::make_unique<const BoundingVolumes>(scene);
}

}  // namespace etendue
