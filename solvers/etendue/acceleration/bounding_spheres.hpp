// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/acceleration/surface_list.hpp"

namespace etendue {

/// A ball, closed.
struct BoundingSphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};

/// Hierarchy of bounding spheres: around each surface that about the centroid of its corners which reaches the farthest
/// of them, around a group one about its box's centre that holds all of theirs. Planes are always tested.  @eq IU.5.7.1
///
/// Accuracy  the hits of BruteForce, bit for bit: spheres are widened by 2^-38 of the distances in a test of them, more
///           than rounding and kTriangleShift together
/// Source    [IU] 5.7.1; groups are those of BoxTree
class BoundingSpheres final : public Accelerator {
 public:
  explicit BoundingSpheres(const Scene& scene);

  [[nodiscard]] Nearest nearest(const Ray& ray) const override;
  [[nodiscard]] Obstruction obstruction(const Ray& ray) const override;

  /// A sphere and what is in it: either two nodes, or the surfaces [first, first + count).
  struct Node {
    BoundingSphere sphere;
    std::uint32_t first = 0;  ///< leaf: into bounded(); inner node: its second child, the first one being the next node
    std::uint32_t count = 0;  ///< 0: inner node
  };
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Surface>& bounded() const { return bounded_; }

 private:
  template <class Visit>
  void walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const;

  std::vector<Node> nodes_;
  std::vector<Surface> bounded_, unbounded_;
};

/// The sphere about the centroid of a surface's corners; a round surface's own. `box` is its bounds().
[[nodiscard]] BoundingSphere bounding_sphere(const Scene& scene, const Surface& surface, const Aabb& box);

}  // namespace etendue
