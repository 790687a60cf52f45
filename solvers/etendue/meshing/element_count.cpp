// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/element_count.hpp"

#include "etendue/meshing/division.hpp"

namespace etendue {

namespace {

struct Counter {
  const Subdivision& asked;

  double face(const Polygon& polygon) const {
    const std::size_t corners = polygon.vertices().size();
    // By counts, only quadrilaterals are divided.
    return corners == 4 || asked.element_size > 0 ? count_of(division_of(asked, polygon), corners) : 1;
  }
  double operator()(const Polygon& shape) const { return face(shape); }
  double operator()(const Triangle& shape) const {
    const auto polygon = Polygon::make({shape.a, shape.b, shape.c});
    return polygon ? face(*polygon) : 1;
  }
  double operator()(const Mesh& shape) const {
    if (!(asked.element_size > 0)) return static_cast<double>(shape.triangles.size());
    double count = 0;
    for (std::size_t k = 0; k < shape.triangles.size(); ++k) count += (*this)(shape.triangle(k));
    return count;
  }
  double operator()(const Box& shape) const {
    const Vec3 edges = 2 * shape.half_edges;
    double count = 0;
    for (int axis = 0; axis < 3; ++axis) {  // two faces each, which run through their edges the other way round
      const double u = edges((axis + 1) % 3), v = edges((axis + 2) % 3);
      count += count_of(division_of(asked, u, v), 4) + count_of(division_of(asked, v, u), 4);
    }
    return count;
  }
  /// All others are not divided.
  template <class Other>
  double operator()(const Other&) const {
    return 0;
  }
};

}  // namespace

std::size_t count_elements(const Scene& scene) {
  double count = 0;
  for (const Object& object : scene.objects) count += std::visit(Counter{object.subdivision}, object.shape);
  return static_cast<std::size_t>(count);  // below 2^25 an object
}

}  // namespace etendue
