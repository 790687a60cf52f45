// SPDX-License-Identifier: Apache-2.0
#include "accelerator_option.hpp"

#include "etendue/acceleration/embree.hpp"

namespace etendue::cli {

namespace {

AcceleratorKind kind_of(const std::string& name) {
  if (name == "spheres") return AcceleratorKind::bounding_spheres;
  if (name == "grid") return AcceleratorKind::grid;
  if (name == "octree") return AcceleratorKind::octree;
  if (name == "embree") return AcceleratorKind::embree;
  return name == "brute" ? AcceleratorKind::brute_force : AcceleratorKind::bounding_volumes;
}

}  // namespace

void add_accelerator(Options& options, std::string& target) {
  options.choice("--accelerator", {"bvh", "spheres", "grid", "octree", "brute", "embree"},
                 "how surfaces are found: hierarchy of boxes, of spheres, grid, octree, or every one: same picture; "
                 "embree: triangles proposed in single precision (default: bvh)",
                 target);
}

Result<std::unique_ptr<const Accelerator>> named_accelerator(const std::string& name, const Scene& scene) {
  const AcceleratorKind kind = kind_of(name);
  if (kind == AcceleratorKind::embree) {
    if (const auto missing = embree_missing()) return *missing;
  }
  return make_accelerator(scene, kind);
}

}  // namespace etendue::cli
