// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/media.hpp"

#include <algorithm>

#include "etendue/geometry/spawn.hpp"

namespace etendue {

namespace {

/// A direction that no modelled edge or face is likely to have; a unit vector to some roundings, which no one relies on.
const Vec3 kAnyDirection(0.3183098861837907, 0.5772156649015329, 0.7519884823893);

template <class T, class... Others>
constexpr bool is_one_of = (std::is_same_v<T, Others> || ...);

/// Whether the shape alone has an inside.
bool is_closed(const Shape& shape) {
  return std::visit(
      [](const auto& each) {
        using T = std::decay_t<decltype(each)>;
        return !is_one_of<T, Polygon, PolygonWithHoles, Triangle, Plane, Disc, Cylinder, Cone, BezierSurface>;
      },
      shape);
}

bool leaves(const SceneHit& hit, const Vec3& direction) {
  return direction.dot(hit.hit.normal) >= 0;
}

/// A body, and how a line from the point meets it first.
struct FirstMeeting {
  Media::Body body;
  bool from_inside;
  bool plane;  ///< met on a plane, which the line to the other side does not meet
};

std::vector<FirstMeeting> meetings(Ray ray, const Accelerator& accelerator) {
  const Scene& scene = accelerator.scene();
  std::vector<FirstMeeting> found;
  while (const auto met = accelerator.nearest(ray).hit) {
    const Object& object = scene.objects[met->object];
    const Media::Body body = Media::body_of(scene, met->object);
    const auto same = [&](const FirstMeeting& earlier) { return earlier.body == body; };
    if (is_transparent(scene.materials[object.material]) && std::none_of(found.begin(), found.end(), same)) {
      found.push_back({body, leaves(*met, ray.direction), std::holds_alternative<Plane>(object.shape)});
    }
    ray.origin = offset_origin(met->hit, ray.direction);
  }
  return found;
}

}  // namespace

double refractive_index(const Material& material, double wavelength) {
  return wavelength > 0 && material.dispersion ? refractive_index(*material.dispersion, wavelength) : material.eta;
}

Media::Body Media::body_of(const Scene& scene, std::size_t object) {
  const std::size_t material = scene.objects[object].material;
  return {is_closed(scene.objects[object].shape) ? object : scene.objects.size() + material, material};
}

void Media::enter(const Body& body) {
  if (!holds(body)) bodies_.push_back(body);
}

void Media::leave(const Body& body) {
  bodies_.erase(std::remove(bodies_.begin(), bodies_.end(), body), bodies_.end());
}

bool Media::holds(const Body& body) const {
  return std::find(bodies_.begin(), bodies_.end(), body) != bodies_.end();
}

std::optional<Media::Body> Media::present(const Scene& scene) const {
  std::optional<Body> best;
  for (const Body& body : bodies_) {
    if (!best || scene.materials[body.material].priority >= scene.materials[best->material].priority) best = body;
  }
  return best;
}

Crossing cross(const Media& around, const SceneHit& hit, const Vec3& direction, const Scene& scene) {
  const Media::Body body = Media::body_of(scene, hit.object);
  Crossing crossing{around, {}, {}};
  if (leaves(hit, direction)) {
    crossing.behind.enter(body);  // if it was there from the beginning
    crossing.before = crossing.behind.present(scene);
    crossing.behind.leave(body);
  } else {
    crossing.before = around.present(scene);
    crossing.behind.enter(body);
  }
  crossing.afterwards = crossing.behind.present(scene);
  return crossing;
}

Media media_around(const Vec3& point, const Accelerator& accelerator, double time) {
  Media media;
  if (!accelerator.has_transparent_surfaces()) return media;
  Ray line;
  line.origin = point;
  line.time = time;
  line.direction = kAnyDirection;
  const std::vector<FirstMeeting> ahead = meetings(line, accelerator);
  line.direction = -kAnyDirection;
  const std::vector<FirstMeeting> back = meetings(line, accelerator);
  const auto holds = [](const std::vector<FirstMeeting>& side, const FirstMeeting& first) {
    return std::any_of(side.begin(), side.end(),
                       [&](const FirstMeeting& other) { return other.body == first.body && other.from_inside; });
  };
  // What is left last lies farthest outside. Planes that only the line backwards meets come outside of all others.
  for (auto met = back.rbegin(); met != back.rend(); ++met) {
    if (met->plane && met->from_inside) media.enter(met->body);
  }
  for (auto met = ahead.rbegin(); met != ahead.rend(); ++met) {
    if (met->from_inside && (met->plane || holds(back, *met))) media.enter(met->body);
  }
  return media;
}

}  // namespace etendue
