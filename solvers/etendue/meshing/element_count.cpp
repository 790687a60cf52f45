// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/element_count.hpp"

#include <algorithm>

namespace etendue {

namespace {

struct Counter {
  std::size_t quadrilateral;  ///< elements of one

  // Only quadrilaterals are divided.
  std::size_t operator()(const Polygon& shape) const { return shape.vertices().size() == 4 ? quadrilateral : 1; }
  std::size_t operator()(const Triangle&) const { return 1; }
  std::size_t operator()(const Mesh& shape) const { return shape.triangles.size(); }
  std::size_t operator()(const Box&) const { return 6 * quadrilateral; }
  std::size_t operator()(const Sphere&) const { return 0; }
  std::size_t operator()(const Cylinder&) const { return 0; }
  std::size_t operator()(const Disc&) const { return 0; }
  std::size_t operator()(const Plane&) const { return 0; }
};

}  // namespace

std::size_t count_elements(const Scene& scene) {
  std::size_t count = 0;
  for (const Object& object : scene.objects) {
    const auto [columns, rows] = object.subdivision.elements;
    const auto cells = static_cast<std::size_t>(std::max(columns, 0)) * static_cast<std::size_t>(std::max(rows, 0));
    count += std::visit(Counter{cells}, object.shape);
  }
  return count;
}

}  // namespace etendue
