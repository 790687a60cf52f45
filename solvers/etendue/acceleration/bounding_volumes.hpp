// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "etendue/acceleration/surface_list.hpp"

namespace etendue {

/// Hierarchy of axis-parallel boxes: the groups of BoxTree, four at a time. A surface is tested only when its box is
/// met, and a box only when it can hold something nearer than the best hit.                        @eq IU.5.7.1
///
/// The boxes are kept in single precision, rounded outward, around the middle of the scene, and four are tested at once;
/// the ray is counted from where it enters the scene, so that its coordinates are no larger than the scene's. Triangles are
/// kept by value, leaf by leaf.
///
/// Accuracy  the hits of BruteForce, bit for bit: no box is left out whose surface would be hit (NOTES.md), hits of
///           equal t are all compared, and a surface is never asked with a shortened ray
/// Source    Wald, Benthin and Boulos 2008, Getting Rid of Packets, doi 10.1109/RT.2008.4634620 (wide nodes)
class BoundingVolumes final : public Accelerator {
 public:
  explicit BoundingVolumes(const Scene& scene);

  [[nodiscard]] Nearest nearest(const Ray& ray) const override;
  [[nodiscard]] Obstruction obstruction(const Ray& ray) const override;

  static constexpr std::size_t kWidth = 4;
  /// Four boxes and what is in each: a node, or the surfaces [first, first + count). Empty ones have low > high.
  struct alignas(64) Node {
    std::array<std::array<float, kWidth>, 3> low, high;  ///< by axis; relative to the scene's middle
    std::array<std::uint32_t, kWidth> first;
    std::array<std::uint32_t, kWidth> count;  ///< 0: a node
  };

 private:
  template <class Visit>
  void walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const;

  std::vector<Node> nodes_;                 // the root first; empty when nothing is bounded
  std::vector<Surface> bounded_;            // leaf by leaf
  std::vector<Surface> unbounded_;          // planes
  std::vector<Triangle> triangles_;         // those of bounded_ that are one …
  std::vector<std::uint32_t> is_triangle_;  // … and which are, one bit each
  Aabb box_;                                // of the scene
  Vec3 middle_ = Vec3::Zero();
};

}  // namespace etendue
