// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/acceleration/accelerator.hpp"

namespace etendue {

enum class RayKind { eye, reflected, transmitted };

/// Why nothing follows a ray of the tree, or what it met.                                          @eq IU.5.5
enum class RayEnd {
  surface,       ///< it met a surface; its children, if the material asks for any, are in the tree
  left_scene,    ///< it met nothing and sees the background (zero only if that is black)
  depth_limit,   ///< not followed: deeper than the greatest level; counts as black
  below_cutoff,  ///< not followed: its weight is below the cutoff; counts as black
};

/// A ray and what became of it.
struct RayNode {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  Ray ray;
  RayKind kind = RayKind::eye;
  RayEnd end = RayEnd::left_scene;
  int level = 0;                ///< rays from the eye are of level 0
  std::size_t parent = kNone;   ///< index of the ray at whose hit this one begins
  double coefficient = 1;       ///< k_r or k_t of the surface where it begins
  double weight = 1;            ///< product of the coefficients along the path: its share in the pixel (E12)
  std::optional<SceneHit> hit;  ///< where end is surface
};

/// All rays that were asked for by one eye ray.                                                    @eq IU.f32, IU.f36
struct RayTree {
  std::vector<RayNode> nodes;  ///< a parent comes before its children, a reflected ray before its transmitted sibling
  TestCount tests;             ///< of the rays that were followed; shadow rays are not part of the tree
};

/// Where a branch of the tree ends, besides leaving the scene.                                     @eq IU.5.5
struct TreeLimits {
  int depth = 5;      ///< greatest level that is followed; 0: rays from the eye only
  double cutoff = 0;  ///< a ray whose weight is smaller is not followed; 0: all are
};

/// Follows a ray from the eye and every reflected and transmitted ray that it causes.
///
/// Where the material has k_r > 0 a reflected ray begins, where k_t > 0 a transmitted one; where they are zero, none.
/// The side is told by the geometric normal: against it, the ray enters and η = 1/eta; along it, it leaves and η = eta.
/// Under total internal reflection nothing is transmitted: the reflected ray then carries k_r + k_t.
/// Secondary rays begin outside the error bound of the hit (offset_origin), so there is no tolerance to choose.
///
/// Domain    ray.direction a unit vector; limits.depth ≥ 0; 0 ≤ limits.cutoff
[[nodiscard]] RayTree trace(const Ray& eye_ray, const Accelerator& accelerator, const TreeLimits& limits);

/// Names of the rays in the manner of figure 36: R for the eye ray; R or T (reflected, transmitted) with the number of
/// the surface where it begins, surfaces being numbered in the order in which they are met.
[[nodiscard]] std::vector<std::string> ray_names(const RayTree& tree);

/// The tree as lines of text, one a ray, indented by level: name, weight, what it met or why it ended.
[[nodiscard]] std::string to_text(const RayTree& tree, const Scene& scene);

/// The tree as a graph in the DOT language of Graphviz, for drawing.
[[nodiscard]] std::string to_dot(const RayTree& tree, const Scene& scene);

}  // namespace etendue
