// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/halved.hpp"

#include <utility>

#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

bool reflects(const Scene& scene, const Object& object) {
  return (scene.materials[object.material].rho > 0).any();
}

}  // namespace

std::vector<std::string> not_halved(const Scene& scene) {
  std::vector<std::string> names;
  for (const Object& object : scene.objects) {
    const auto& counts = object.subdivision.elements;
    if (reflects(scene, object) && (counts[0] == 1 || counts[1] == 1)) names.push_back(object.name);
  }
  return names;
}

Result<Scene> with_half_the_elements(Scene scene) {
  std::string text;
  std::size_t errors = 0;
  bool any_reflects = false, any_is_halved = false;
  for (Object& object : scene.objects) {
    bool even = true;
    const auto& counts = object.subdivision.elements;
    any_reflects = any_reflects || reflects(scene, object);
    any_is_halved = any_is_halved || (reflects(scene, object) && (counts[0] > 1 || counts[1] > 1));
    for (int& count : object.subdivision.elements) {
      even = even && (count == 1 || count % 2 == 0);
      if (count > 1) count /= 2;
    }
    for (int& count : object.subdivision.patches) count = 1;
    if (object.subdivision.element_size > 0) {
      text += (object.place.empty() ? "" : object.place + ": ") + "object '" + printable(object.name) +
              "' has an element size: extrapolation halves numbers of \"elements\"\n";
      ++errors;
      continue;
    }
    if (even) continue;
    text += (object.place.empty() ? "" : object.place + ": ") + "object '" + printable(object.name) +
            "' has an odd number of elements along an edge: extrapolation halves them\n";
    ++errors;
  }
  if (errors == 0 && any_reflects && !any_is_halved) {
    return Error{ErrorCode::invalid_input,
                 "nothing that reflects has more than one element along an edge: no mesh is coarser, so that there is "
                 "nothing to extrapolate from; divide the objects (\"elements\")"};
  }
  if (errors > 0) return Error{ErrorCode::invalid_input, text + counted_errors(errors)};
  return scene;
}

}  // namespace etendue
