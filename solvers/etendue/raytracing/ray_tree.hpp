// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/raytracing/media.hpp"
#include "etendue/raytracing/sample_key.hpp"

namespace etendue {

enum class RayKind { eye, reflected, transmitted };

/// Why nothing follows a ray of the tree, or what it met.                                          @eq IU.5.5
enum class RayEnd {
  surface,       ///< it met a surface; its children, if the material asks for any, are in the tree
  left_scene,    ///< it met nothing and sees the background (zero only if that is black)
  depth_limit,   ///< not followed: deeper than the greatest level; counts as black
  below_cutoff,  ///< not followed: its weight is below the cutoff; counts as black
  environment,   ///< not followed: it sees the images that the mirror's material has of its surroundings
};

/// A ray and what became of it.
struct RayNode {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  Ray ray;  ///< one that goes straight on keeps the origin of the ray before and begins at its t_min
  RayKind kind = RayKind::eye;
  RayEnd end = RayEnd::left_scene;
  int level = 0;               ///< rays from the eye are of level 0
  std::size_t parent = kNone;  ///< index of the ray at whose hit this one begins
  double coefficient = 1;      ///< share of it that the surface where it begins sends on: k_r or k_t, or by Fresnel
  double weight = 1;  ///< its share in the pixel (E12): product of the coefficients along the path, and of what
                      ///< the bodies that it passed leave of the channel they leave most of
  std::optional<SceneHit> hit;                              ///< where end is surface; its t is counted from ray.origin
  Media media;                                              ///< the bodies that it travels in
  std::optional<std::size_t> medium = std::nullopt;         ///< the material of the one that counts, if any
  double length = std::numeric_limits<double>::infinity();  ///< from where it begins to the hit
  double before = 0;                                        ///< of the rays that lead from the eye to there
};

/// All rays that were asked for by one eye ray.                                                    @eq IU.f32, IU.f36
struct RayTree {
  double wavelength = 0;       ///< as traced [nm]; 0: all at once
  std::vector<RayNode> nodes;  ///< a parent comes before its children, a reflected ray before its transmitted sibling
  TestCount tests;             ///< of the rays that were followed; shadow rays are not part of the tree
};

/// Where a branch of the tree ends, besides leaving the scene.                                     @eq IU.5.5
struct TreeLimits {
  int depth = 5;      ///< greatest level that is followed; 0: rays from the eye only
  double cutoff = 0;  ///< a ray whose weight is smaller is not followed; 0: all are
};

/// What an eye ray begins with.
struct RayStart {
  Media media;            ///< media_around() the eye; without it, the eye stands where no body is
  double wavelength = 0;  ///< [nm] of refractive indices; 0: those for all light at once
  SampleKey key = {};     ///< ray i, where it strays in frosted surfaces, draws from key.part(i)
};

/// Follows a ray from the eye and every reflected and transmitted ray that it causes.       @eq IU.5-2, IU.4-6, IU.5-7
///
/// Where the material has k_r > 0 a reflected ray begins, where k_t > 0 a transmitted one; where they are zero, none.
/// With Fresnel's factor F the reflected ray carries (k_r + k_t) F, the transmitted one (k_r + k_t)(1 − F), if k_t > 0.
/// η is the quotient of the indices on the two sides, which cross() finds: a bubble in glass in water is right. A surface
/// that lies hidden in a body of higher priority is passed as if it were not there. Where the index stays the same the
/// ray goes straight on, to the last bit. Through frost it strays as frosted() says, to either side of that.     @eq IU.4.3d
/// Where the material has an environment, a ray mirrored outside ends in it, whatever the limits.         @eq IU.4.1.3
/// Under total internal reflection nothing is transmitted: the reflected ray then carries k_r + k_t.
/// Secondary rays begin outside the error bound of the hit (offset_origin), so there is no tolerance to choose.
///
/// Domain    ray.direction a unit vector; limits.depth ≥ 0; 0 ≤ limits.cutoff; a wavelength is visible
[[nodiscard]] RayTree trace(const Ray& eye_ray, const Accelerator& accelerator, const TreeLimits& limits,
                            const RayStart& start = {});

/// Leaves the memory of a tree that is no longer wanted to the next one that this thread traces.
void recycle(RayTree&& tree);

/// Names of the rays in the manner of figure 36: R for the eye ray; R or T (reflected, transmitted) with the number of
/// the surface where it begins, surfaces being numbered in the order in which they are met.
[[nodiscard]] std::vector<std::string> ray_names(const RayTree& tree);

/// The tree as lines of text, one a ray, indented by level: name, weight, what it met or why it ended.
[[nodiscard]] std::string to_text(const RayTree& tree, const Scene& scene);

/// The tree as a graph in the DOT language of Graphviz, for drawing.
[[nodiscard]] std::string to_dot(const RayTree& tree, const Scene& scene);

}  // namespace etendue
