// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/mesh.hpp"

namespace etendue {

std::optional<Hit> intersect(const Ray& ray, const Mesh& mesh) {
  Ray rest = ray;
  std::optional<Hit> nearest;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto hit = intersect(rest, mesh.triangle(i));
    if (!hit) continue;
    nearest = hit;
    rest.t_max = hit->t;
  }
  return nearest;
}

}  // namespace etendue
