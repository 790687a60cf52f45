// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ with colours at the vertices.
#include <algorithm>

#include "etendue/io/image_file.hpp"
#include "etendue/io/solution_file.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

/// One line, in which no backslash asks to go on with the next.
std::string line_of(const std::string& name) {
  std::string text = printable(name);
  std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

}  // namespace

std::string solution_obj(const SolvedSurfaces& solved) {
  std::string text = "# Radiosities [W/m2] times exposure " + shortest(solved.exposure) +
                     ", cut at 1, sRGB-encoded: v x y z red green blue; lengths in scene units\n";
  std::size_t used = 0;
  const Face* last = nullptr;
  for (std::size_t k = 0; k < solved.mesh.elements.size(); ++k) {
    const Element& element = solved.mesh.elements[k];
    const Face& face = solved.mesh.face_of(element);
    if (!last || last->object != face.object) text += "o " + line_of(solved.scene.objects[face.object].name) + '\n';
    last = &face;
    const auto& vertices = element.polygon.vertices();
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      text += 'v';
      for (Eigen::Index c = 0; c < 3; ++c) text += ' ' + shortest(vertices[v](c));
      const Rgb& shade = solved.vertices.corners[k][v];
      for (Eigen::Index c = 0; c < 3; ++c) {
        text += ' ' + shortest(srgb_encode(std::clamp(solved.exposure * shade(c), 0.0, 1.0)));
      }
      text += '\n';
    }
    text += 'f';
    for (std::size_t v = 0; v < vertices.size(); ++v) text += ' ' + std::to_string(++used);
    text += '\n';
  }
  return text;
}

}  // namespace etendue
