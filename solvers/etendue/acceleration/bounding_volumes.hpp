// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/acceleration/surface_list.hpp"

namespace etendue {

/// Hierarchy of axis-parallel boxes, one around each surface, one around each pair of groups, up to the whole scene;
/// planes have no box and are always tested. A surface is tested only when its box is met, and a box only when it can
/// hold something nearer than the best hit.                                                    @eq IU.5.7.1
///
/// The tree is built from the top: the surfaces, sorted by the middle of their boxes along each axis in turn, are cut
/// where  area(left) count(left) + area(right) count(right)  is least, the expected number of tests of a random ray.
///
/// Accuracy  the hits of BruteForce, bit for bit: RayBoxTest never leaves out a box whose surface would be hit, hits of
///           equal t are all compared, and a surface is never asked with a shortened ray
/// Source    Goldsmith and Salmon 1987 (cost of a cut)
class BoundingVolumes final : public Accelerator {
 public:
  explicit BoundingVolumes(const Scene& scene);

  [[nodiscard]] Nearest nearest(const Ray& ray) const override;
  [[nodiscard]] Obstruction obstruction(const Ray& ray) const override;

  /// A box and what is in it: either two nodes, or the surfaces [first, first + count).
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< leaf: into bounded(); inner node: its second child, the first one being the next node
    std::uint32_t count = 0;  ///< 0: inner node
    int axis = 0;             ///< inner node: along which the two were told apart
  };
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Surface>& bounded() const { return bounded_; }
  [[nodiscard]] const std::vector<Surface>& unbounded() const { return unbounded_; }

 private:
  struct Item {
    Surface surface;
    Aabb box;
    Vec3 middle;
  };
  template <class Visit>
  void walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const;
  void build(std::vector<Item>& items, std::size_t begin, std::size_t end, int level);

  std::vector<Node> nodes_;         // in preorder; empty when nothing is bounded
  std::vector<Surface> bounded_;    // leaf by leaf
  std::vector<Surface> unbounded_;  // planes
};

}  // namespace etendue
