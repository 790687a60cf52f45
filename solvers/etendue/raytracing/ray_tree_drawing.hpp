// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/raytracing/ray_tree.hpp"

namespace etendue {

/// Where the rays of a tree are drawn.
struct TreeLayout {
  std::vector<double> across;  ///< of each ray's end, counted in columns from 0
  double columns = 1;          ///< how many there are
  int levels = 1;              ///< rows of ends
};

/// Rays that cause no others take a column each, from left to right in the tree's order; every other ray ends in the middle
/// above those that it causes. So no two lines cross and no two ends share a place.
[[nodiscard]] TreeLayout layout(const RayTree& tree);

/// The tree as a picture (SVG): the eye on top, a circle where a ray meets a surface, with the object's name, and in words
/// why a ray ended elsewhere. Reflected rays are drawn solid, transmitted ones dashed, each with its name and the product of
/// the coefficients along its path.                                                          @eq IU.f32, IU.f36
[[nodiscard]] std::string to_svg(const RayTree& tree, const Scene& scene);

}  // namespace etendue
