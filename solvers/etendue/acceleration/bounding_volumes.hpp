// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/acceleration/wide_tree.hpp"

namespace etendue {

/// Hierarchy of axis-parallel boxes: the groups of BoxTree, eight at a time. A surface is tested only when its box is
/// met, and a box only when it can hold something nearer than the best hit.                        @eq IU.5.7.1
///
/// Boxes and triangles are first looked at in single precision, eight and four at once; what is not surely missed is
/// tested in full. The ray is counted from where it enters the scene, so that its coordinates are no larger than the
/// scene's.
///
/// Accuracy  the hits of BruteForce, bit for bit: no box is left out whose surface would be hit (NOTES.md), hits of
///           equal t are all compared, and a surface is never asked with a shortened ray
/// Source    Wald, Benthin and Boulos 2008, Getting Rid of Packets, doi 10.1109/RT.2008.4634620 (wide nodes);
///           Ylitie, Karras and Laine 2017, doi 10.1145/3105762.3105773 (a byte a coordinate)
class BoundingVolumes final : public Accelerator {
 public:
  explicit BoundingVolumes(const Scene& scene);
  /// Of these surfaces only.
  BoundingVolumes(const Scene& scene, const std::vector<Surface>& all);

  [[nodiscard]] Nearest nearest(const Ray& ray) const override;
  [[nodiscard]] Obstruction obstruction(const Ray& ray) const override;

  [[nodiscard]] const WideTree& tree() const { return tree_; }

 private:
  template <class Visit>
  void walk(const Ray& ray, TestCount& tests, Visit visit) const;

  WideTree tree_;
};

}  // namespace etendue
