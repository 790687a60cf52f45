// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/accelerator.hpp"

#include "etendue/acceleration/bounding_volumes.hpp"
#include "etendue/acceleration/brute_force.hpp"

namespace etendue {

std::unique_ptr<const Accelerator> make_accelerator(const Scene& scene, AcceleratorKind kind) {
  if (kind == AcceleratorKind::brute_force) return std::make_unique<const BruteForce>(scene);
  return std::make_unique<const BoundingVolumes>(scene);
}

}  // namespace etendue
