// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "etendue/acceleration/surface_list.hpp"

namespace etendue {

/// Groups of surfaces within groups: one box around each, up to the whole scene. Planes have no box and stay apart.
///                                                                                              @eq IU.5.7.1
/// Built from the top: the middles of the boxes are sorted into kBins equal bins along each axis, and a group is cut
/// between the bins where  area(left) count(left) + area(right) count(right)  is least, the expected number of tests of
/// a random ray.
///
/// Source    Goldsmith and Salmon 1987 (cost of a cut); Wald 2007, On fast Construction of SAH-based Bounding Volume
///           Hierarchies, doi 10.1109/RT.2007.4342588 (bins)
struct BoxTree {
  explicit BoxTree(const Scene& scene) : BoxTree(scene, surfaces(scene)) {}
  /// Of these surfaces only.
  BoxTree(const Scene& scene, const std::vector<Surface>& all);

  /// A box and what is in it: either two nodes, or the surfaces [first, first + count).
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< leaf: into bounded; inner node: its second child, the first one being the next node
    std::uint32_t count = 0;  ///< 0: inner node
    int axis = 0;             ///< inner node: along which the two were told apart
  };
  std::vector<Node> nodes;         ///< in preorder; empty when nothing is bounded
  std::vector<Surface> bounded;    ///< leaf by leaf
  std::vector<Surface> unbounded;  ///< planes

  /// No path from the root is longer.
  static constexpr int kDeepest = 40 + 32;
};

}  // namespace etendue
