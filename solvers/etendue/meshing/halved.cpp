// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/halved.hpp"

#include <utility>

#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

Result<Scene> with_half_the_elements(Scene scene) {
  std::string text;
  std::size_t errors = 0;
  for (Object& object : scene.objects) {
    bool even = true;
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
  if (errors > 0) return Error{ErrorCode::invalid_input, text + counted_errors(errors)};
  return scene;
}

}  // namespace etendue
