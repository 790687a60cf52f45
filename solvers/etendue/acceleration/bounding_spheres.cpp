// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/bounding_spheres.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "etendue/acceleration/box_tree.hpp"
#include "etendue/acceleration/search.hpp"

namespace etendue {

namespace {

constexpr std::size_t kStack = BoxTree::kDeepest + 2;
/// Of the distances in a test: roundings, and kTriangleShift of the distance of a triangle.
constexpr double kSlack = 0x1p-38;

/// About the corners' centroid, out to the farthest of them, and a little farther for the rounding of both.
template <class Corners>
BoundingSphere around(const Corners& corners) {
  BoundingSphere sphere;
  for (const Vec3& corner : corners) sphere.centre += corner / static_cast<double>(corners.size());
  for (const Vec3& corner : corners) sphere.radius = std::max(sphere.radius, (corner - sphere.centre).norm());
  sphere.radius += kSlack * (sphere.radius + sphere.centre.lpNorm<Eigen::Infinity>());
  return sphere;
}

std::array<Vec3, 8> corners_of(const Aabb& box) {
  std::array<Vec3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k) {
    corners[k] = {k & 1 ? box.high.x() : box.low.x(), k & 2 ? box.high.y() : box.low.y(),
                  k & 4 ? box.high.z() : box.low.z()};
  }
  return corners;
}

/// Whether the ray may meet a sphere before t_max.
class RaySphereTest {
 public:
  explicit RaySphereTest(const Ray& ray)
      : origin_(ray.origin), direction_(ray.direction.normalized()), speed_(ray.direction.norm()), first_(ray.t_min) {}

  bool meets(const BoundingSphere& sphere, double t_max) const {
    const Vec3 way = sphere.centre - origin_;
    const double distance = way.norm();
    const double radius = sphere.radius + kSlack * (distance + origin_.lpNorm<Eigen::Infinity>() +
                                                    sphere.centre.lpNorm<Eigen::Infinity>() + sphere.radius);
    if (distance <= radius) return true;
    const double along = way.dot(direction_);
    if (along < 0 || direction_.cross(way).norm() > radius) return false;
    return along - radius <= t_max * speed_ && along + radius >= first_ * speed_;
  }

 private:
  Vec3 origin_, direction_;
  double speed_, first_;
};

}  // namespace

BoundingSphere bounding_sphere(const Scene& scene, const Surface& surface, const Aabb& box) {
  const Shape& shape = scene.objects[surface.object].shape;
  if (moves(scene, scene.objects[surface.object])) return around(corners_of(box));
  if (const auto* polygon = std::get_if<Polygon>(&shape)) return around(polygon->vertices());
  if (const auto* triangle = std::get_if<Triangle>(&shape)) {
    return around(std::array<Vec3, 3>{triangle->a, triangle->b, triangle->c});
  }
  if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    const Triangle triangle = mesh->triangle(surface.part);
    return around(std::array<Vec3, 3>{triangle.a, triangle.b, triangle.c});
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return {sphere->centre, sphere->radius};
  if (const auto* disc = std::get_if<Disc>(&shape)) return {disc->centre, disc->radius};
  return around(corners_of(box));
}

BoundingSpheres::BoundingSpheres(const Scene& scene) : Accelerator(scene) {
  BoxTree boxes(scene);
  bounded_ = std::move(boxes.bounded);
  unbounded_ = std::move(boxes.unbounded);
  nodes_.resize(boxes.nodes.size());
  // Children stand behind their parent: from the back, each sphere is ready when it is needed.
  std::vector<BoundingSphere> of_surface;
  for (const Surface& surface : bounded_)
    of_surface.push_back(bounding_sphere(scene, surface, *bounds(scene, surface)));
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const BoxTree::Node& from = boxes.nodes[i];
    Node& node = nodes_[i];
    node.first = from.first;
    node.count = from.count;
    node.sphere.centre = from.box.centre();
    const auto include = [&](const BoundingSphere& part) {
      node.sphere.radius = std::max(node.sphere.radius, (part.centre - node.sphere.centre).norm() + part.radius);
    };
    for (std::size_t k = 0; k < node.count; ++k) include(of_surface[node.first + k]);
    if (node.count == 1) node.sphere = of_surface[node.first];
    if (node.count == 0) {
      include(nodes_[i + 1].sphere);
      include(nodes_[node.first].sphere);
    }
    node.sphere.radius *= 1 + kSlack;
  }
}

// Calls visit(surface) for each surface in a sphere that the ray may meet before `limit`; ends when visit returns false.
template <class Visit>
void BoundingSpheres::walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const {
  if (nodes_.empty()) return;
  const RaySphereTest test(ray);
  std::array<std::uint32_t, kStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t index = stack[--waiting];
    const Node& node = nodes_[index];
    ++tests.volumes;
    if (!test.meets(node.sphere, beyond(limit))) continue;
    for (std::size_t k = 0; k < node.count; ++k) {
      ++tests.surfaces;
      if (!visit(bounded_[node.first + k])) return;
    }
    if (node.count > 0) continue;
    const Vec3 between = nodes_[node.first].sphere.centre - nodes_[index + 1].sphere.centre;
    const bool second_is_nearer = between.dot(ray.direction) < 0;  // a guess, for speed only
    stack[waiting++] = second_is_nearer ? index + 1 : node.first;
    stack[waiting++] = second_is_nearer ? node.first : index + 1;
  }
}

Nearest BoundingSpheres::nearest(const Ray& ray) const {
  NearestSearch search(scene(), ray);
  for (const Surface& surface : unbounded_) search.try_counted(surface);
  walk(ray, search.tests(), search.limit(), [&](const Surface& surface) {
    search.try_surface(surface);
    return true;
  });
  return search.answer();
}

Obstruction BoundingSpheres::obstruction(const Ray& ray) const {
  ObstructionSearch search(scene(), ray);
  if (search.any_blocks(unbounded_)) return search.answer();
  walk(ray, search.tests(), ray.t_max, [&](const Surface& surface) { return !search.blocks(surface); });
  return search.answer();
}

}  // namespace etendue
