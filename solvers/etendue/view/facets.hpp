// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "etendue/view/shaded_view.hpp"

namespace etendue {

/// A triangle of the scene, its normals on the viewer's side.
struct Facet {
  std::size_t object;
  std::array<Vec3, 3> corners, normals;
  Vec3 normal;
  bool turned = false;                  // outward is away from the viewer
  std::array<Vec2, 3> parameters = {};  // of the corners

  Vec3 centre() const { return (corners[0] + corners[1] + corners[2]) / 3; }
};

/// The surfaces of a scene as triangles.
/// Errors    those of tessellated(); infinite planes, where light is computed at corners
[[nodiscard]] Result<std::vector<Facet>> facets_of(const Scene& scene, const ShadingOptions& options);

/// The diagonal of the box around all that is finite, 1 where nothing is; the eye's height above an infinite plane where that is
/// less: nothing of a plane is nearer.
[[nodiscard]] double length_to_see(const Scene& scene, const std::vector<Facet>& facets);

}  // namespace etendue
