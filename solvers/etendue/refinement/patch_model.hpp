// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// Patches that shoot and elements that receive, over the same faces.                                @eq IU.6.7.1
struct PatchModel {
  ElementMesh patches;              ///< element k is patch k, whole
  ElementMesh elements;             ///< Element::patch says what each is a part of
  std::vector<double> patch_areas;  ///< [m²]; of each the sum over its elements, so that power is neither lost nor won
  std::vector<double> element_areas;   ///< [m²]
  std::vector<std::size_t> materials;  ///< of each patch, and so of its elements; index into Scene::materials

  std::size_t patch_of(std::size_t element) const { return elements.elements[element].patch; }
  const Material& material_of(const Scene& scene, std::size_t patch) const { return scene.materials[materials[patch]]; }
};

/// Patches as the objects' subdivisions have them: blocks of elements of one face.
///
/// Contract  `elements` was made of `scene` by mesh_elements()
/// Returns   patches whose corners are corners of their elements, to the last bit
/// Errors    a patch that is no polygon: its elements are, but its corners round to a line
[[nodiscard]] Result<PatchModel> patch_model(const Scene& scene, ElementMesh elements);

/// The same patches over other elements, each a part of the patch it names.
[[nodiscard]] PatchModel with_elements(const PatchModel& model, const Scene& scene, ElementMesh elements);

}  // namespace etendue
