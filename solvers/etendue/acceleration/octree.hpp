// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/acceleration/surface_list.hpp"

namespace etendue {

/// When a voxel is divided.
struct OctreeLimits {
  std::size_t most_surfaces = 8;  ///< a voxel with more of them is divided …
  int depth = 12;                 ///< … unless it is this many divisions deep
};

/// A cube around the scene, divided into eight as long as a voxel holds more than a maximum of surfaces and depth
/// allows; the voxels a ray passes are visited in its order.                                @eq IU.5.7.2b, IU.f44
///
/// A surface lies in every voxel its box touches and is tested once a ray. A voxel whose eight parts would all hold all
/// of its surfaces is not divided. Planes are always tested.
///
/// Accuracy  the hits of BruteForce, bit for bit: voxels are visited where RayBoxTest meets them, and the search ends
///           where the next voxel lies behind the best hit
/// Source    Glassner 1984, Space Subdivision for Fast Ray Tracing
class Octree final : public Accelerator {
 public:
  explicit Octree(const Scene& scene, const OctreeLimits& limits = {});

  [[nodiscard]] Nearest nearest(const Ray& ray) const override;
  [[nodiscard]] Obstruction obstruction(const Ray& ray) const override;

  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< leaf: into listed(); else its first child of eight
    std::uint32_t count = 0;  ///< leaf: surfaces in it
    bool leaf = true;
  };
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Indices into bounded(), leaf by leaf.
  [[nodiscard]] const std::vector<std::uint32_t>& listed() const { return listed_; }
  [[nodiscard]] const std::vector<Surface>& bounded() const { return bounded_; }

 private:
  void divide(std::size_t node, const std::vector<std::uint32_t>& inside, int depth);
  template <class Visit>
  void walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const;

  OctreeLimits limits_;
  std::vector<Aabb> boxes_;  // of bounded_
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> listed_;
  std::vector<Surface> bounded_, unbounded_;
  std::uint64_t owner_;  // of mailboxes
};

}  // namespace etendue
