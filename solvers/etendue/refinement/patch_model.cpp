// SPDX-License-Identifier: Apache-2.0
#include "etendue/refinement/patch_model.hpp"

#include <utility>

#include "etendue/meshing/division.hpp"

namespace etendue {

namespace {

/// The elements of each patch, in their order.
std::vector<std::vector<std::size_t>> parts_of(const ElementMesh& mesh) {
  std::vector<std::vector<std::size_t>> parts(mesh.patches);
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) parts[mesh.elements[k].patch].push_back(k);
  return parts;
}

/// A block of cells that follow one another along the first edge fastest, `columns` in a row.
Result<Polygon> outline(const ElementMesh& mesh, const std::vector<std::size_t>& block, std::size_t columns) {
  const auto corner = [&](std::size_t cell, std::size_t at) {
    return mesh.elements[block[cell]].polygon.vertices()[at];
  };
  const std::size_t last = block.size() - 1;
  return Polygon::make({corner(0, 0), corner(columns - 1, 1), corner(last, 2), corner(last - (columns - 1), 3)});
}

void measure(PatchModel& model, const Scene& scene) {
  const double square_metres = scene.metres_per_unit * scene.metres_per_unit;
  model.patch_areas.assign(model.patches.elements.size(), 0.0);
  model.element_areas.clear();
  for (const Element& element : model.elements.elements) {
    const double area = element.polygon.area() * square_metres;
    model.element_areas.push_back(area);
    model.patch_areas[element.patch] += area;
  }
}

}  // namespace

Result<PatchModel> patch_model(const Scene& scene, ElementMesh elements) {
  PatchModel model;
  model.patches.faces = elements.faces;
  model.patches.patches = elements.patches;
  const auto parts = parts_of(elements);
  std::vector<std::size_t> sizes(elements.faces.size(), 0);  // elements of each face
  for (const Element& element : elements.elements) ++sizes[element.face];
  for (std::size_t patch = 0; patch < parts.size(); ++patch) {
    const Element& first = elements.elements[parts[patch].front()];
    const Face& face = elements.faces[first.face];
    model.materials.push_back(face.material);
    if (parts[patch].size() == 1 || parts[patch].size() == sizes[first.face]) {
      const Polygon& polygon = parts[patch].size() == 1 ? first.polygon : face.polygon;
      model.patches.elements.push_back({polygon, first.face, patch});
      continue;
    }
    const Subdivision division = division_of(scene.objects[face.object].subdivision, face.polygon);
    auto whole = outline(elements, parts[patch], static_cast<std::size_t>(division.elements[0] / division.patches[0]));
    if (!whole)
      return Error{whole.error().code,
                   "a patch of object '" + scene.objects[face.object].name + "': " + whole.error().message};
    model.patches.elements.push_back({std::move(whole).value(), first.face, patch});
  }
  model.elements = std::move(elements);
  measure(model, scene);
  return model;
}

PatchModel with_elements(const PatchModel& model, const Scene& scene, ElementMesh elements) {
  require(elements.patches == model.patches.patches, "with_elements: the same patches");
  PatchModel other{model.patches, std::move(elements), {}, {}, model.materials};
  measure(other, scene);
  return other;
}

}  // namespace etendue
