// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "etendue/acceleration/surface_list.hpp"

namespace etendue {

/// A box around the scene, divided into L × M × N equal voxels with lists of the surfaces in them; a ray is followed
/// from voxel to voxel until the best hit lies in one that it has passed.                  @eq IU.5.7.2a, IU.f43
///
/// A surface lies in every voxel its box touches and is tested once a ray; a hit outside the voxel in which it was
/// found does not end the walk. Planes are always tested.
///
/// Accuracy  the hits of BruteForce, bit for bit: surfaces are listed with a margin of kGridMargin of a voxel, which is
///           more than the walk's rounding errs; a ray for which it could be less (from 10⁹ voxels away) tests all
/// Source    Amanatides and Woo 1987, A Fast Voxel Traversal Algorithm for Ray Tracing
class Grid final : public Accelerator {
 public:
  using Divisions = std::array<int, 3>;

  /// About two voxels a surface, as cubic as the scene allows; or as many as given (each ≥ 1).
  explicit Grid(const Scene& scene);
  Grid(const Scene& scene, const Divisions& divisions);

  [[nodiscard]] Nearest nearest(const Ray& ray) const override;
  [[nodiscard]] Obstruction obstruction(const Ray& ray) const override;

  [[nodiscard]] const Divisions& divisions() const { return divisions_; }
  [[nodiscard]] const Aabb& box() const { return box_; }

 private:
  void list_surfaces();
  [[nodiscard]] std::size_t voxel(const std::array<int, 3>& place) const;
  /// The voxels along axis `k` that [low, high] touches, first and last.
  [[nodiscard]] std::array<int, 2> range(int k, double low, double high) const;
  template <class Visit>
  void walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const;

  Divisions divisions_{1, 1, 1};
  Aabb box_;
  Vec3 edge_ = Vec3::Ones();  // of a voxel
  std::vector<Surface> bounded_, unbounded_;
  std::vector<Aabb> boxes_;           // of bounded_
  std::vector<std::uint32_t> first_;  // voxel v lists listed_[first_[v] .. first_[v + 1])
  std::vector<std::uint32_t> listed_;
  std::uint64_t owner_;  // of mailboxes
};

/// By how much of a voxel's edge the boxes of surfaces are widened before they are listed.
inline constexpr double kGridMargin = 0x1p-12;

}  // namespace etendue
