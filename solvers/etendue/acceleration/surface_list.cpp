// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/surface_list.hpp"

#include <tuple>
#include <type_traits>

namespace etendue {

std::vector<Surface> surfaces(const Scene& scene) {
  std::vector<Surface> all;
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    const auto* mesh = std::get_if<Mesh>(&scene.objects[object].shape);
    const std::size_t parts = mesh ? mesh->triangles.size() : 1;
    for (std::size_t part = 0; part < parts; ++part) all.push_back({object, part});
  }
  return all;
}

std::optional<Hit> intersect(const Ray& ray, const Scene& scene, const Surface& surface) {
  return std::visit(
      [&](const auto& shape) -> std::optional<Hit> {
        if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, Mesh>) {
          return intersect(ray, shape.triangle(surface.part));
        } else {
          return intersect(ray, shape);
        }
      },
      scene.objects[surface.object].shape);
}

Sight sight(const Ray& ray, const Scene& scene, const Surface& surface) {
  return std::visit([&](const auto& shape) { return sight(ray, shape); }, scene.objects[surface.object].shape);
}

std::optional<Aabb> bounds(const Scene& scene, const Surface& surface) {
  return std::visit(
      [&](const auto& shape) -> std::optional<Aabb> {
        using Type = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Type, Plane>) {
          return std::nullopt;
        } else if constexpr (std::is_same_v<Type, Mesh>) {
          return bounds(shape.triangle(surface.part));
        } else {
          return bounds(shape);
        }
      },
      scene.objects[surface.object].shape);
}

bool precedes(const SceneHit& a, const SceneHit& b) {
  return std::tie(a.hit.t, a.object, a.part) < std::tie(b.hit.t, b.object, b.part);
}

}  // namespace etendue
