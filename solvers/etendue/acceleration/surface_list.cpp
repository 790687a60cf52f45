// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/surface_list.hpp"

#include <tuple>
#include <type_traits>

#include "etendue/core/rounding.hpp"

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

namespace {

std::optional<Hit> intersect_at_rest(const Ray& ray, const Scene& scene, const Surface& surface) {
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

/// What moves is met by a ray that moves against it. The two differences that it takes, and the way back, err by less than
/// u of each of their terms; that joins the bounds of the hit, for points as for the ray that begins there.
std::optional<Hit> intersect_moving(const Ray& ray, const Vec3& way, const Scene& scene, const Surface& surface) {
  Ray against = ray;
  against.origin -= way;
  auto hit = intersect_at_rest(against, scene, surface);
  if (!hit) return hit;
  hit->point += way;
  const double rounding = 2 * kUnitRoundoff * (ray.origin.lpNorm<1>() + hit->point.lpNorm<1>() + 2 * way.lpNorm<1>());
  hit->point_error += rounding;
  hit->surface_error += rounding;
  return hit;
}

std::optional<Aabb> bounds_at_rest(const Scene& scene, const Surface& surface) {
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

}  // namespace

std::optional<Hit> intersect(const Ray& ray, const Scene& scene, const Surface& surface) {
  if (ray.time == 0) return intersect_at_rest(ray, scene, surface);
  const Vec3& velocity = scene.objects[surface.object].velocity;
  if (velocity == Vec3::Zero()) return intersect_at_rest(ray, scene, surface);
  return intersect_moving(ray, ray.time * velocity, scene, surface);
}

Sight sight(const Ray& ray, const Scene& scene, const Surface& surface) {
  const auto of = [&](const Ray& against) {
    return std::visit([&](const auto& shape) { return sight(against, shape); }, scene.objects[surface.object].shape);
  };
  if (ray.time == 0) return of(ray);
  Ray against = ray;  // as intersect_moving() does it, to the last bit
  against.origin -= ray.time * scene.objects[surface.object].velocity;
  return of(against);
}

std::optional<Aabb> bounds(const Scene& scene, const Surface& surface) {
  auto box = bounds_at_rest(scene, surface);
  const Object& object = scene.objects[surface.object];
  if (!box || box->empty() || !moves(scene, object)) return box;
  const Vec3 way = scene.camera.shutter * object.velocity;
  // A rounding each of the way, of the sum, and of what intersect_moving() makes of them.
  const Vec3 room = 8 * kUnitRoundoff * (box->low.cwiseAbs().cwiseMax(box->high.cwiseAbs()) + way.cwiseAbs());
  box->low = box->low.cwiseMin(box->low + way) - room;
  box->high = box->high.cwiseMax(box->high + way) + room;
  return box;
}

bool precedes(const SceneHit& a, const SceneHit& b) {
  return std::tie(a.hit.t, a.object, a.part) < std::tie(b.hit.t, b.object, b.part);
}

}  // namespace etendue
