// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/bounding_volumes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "etendue/acceleration/search.hpp"

namespace etendue {

namespace {

/// Up to here testing the surfaces costs less than testing boxes around them.
constexpr std::size_t kLeafSurfaces = 2;
/// From this level on groups are halved, so that no tree is deeper than this plus log2 of the number of surfaces.
constexpr int kHalvingLevel = 40;
constexpr std::size_t kStack = 128;  // > kHalvingLevel + 64
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double half_area(const Aabb& box) {
  const Vec3 edge = box.high - box.low;
  return edge.x() * edge.y() + edge.y() * edge.z() + edge.z() * edge.x();
}

}  // namespace

BoundingVolumes::BoundingVolumes(const Scene& scene) : Accelerator(scene) {
  std::vector<Item> items;
  for (const Surface& surface : surfaces(scene)) {
    const auto box = bounds(scene, surface);
    if (box) {
      items.push_back({surface, *box, box->centre()});
    } else {
      unbounded_.push_back(surface);
    }
  }
  nodes_.reserve(2 * items.size());
  bounded_.reserve(items.size());
  if (!items.empty()) build(items, 0, items.size(), 0);
}

void BoundingVolumes::build(std::vector<Item>& items, std::size_t begin, std::size_t end, int level) {
  const std::size_t index = nodes_.size();
  const std::size_t count = end - begin;
  nodes_.push_back({items[begin].box, 0, 0, 0});
  for (std::size_t i = begin; i < end; ++i) nodes_[index].box = united(nodes_[index].box, items[i].box);
  if (count <= kLeafSurfaces) {
    nodes_[index].first = static_cast<std::uint32_t>(bounded_.size());
    nodes_[index].count = static_cast<std::uint32_t>(count);
    for (std::size_t i = begin; i < end; ++i) bounded_.push_back(items[i].surface);
    return;
  }

  const auto sort_along = [&](int axis) {
    std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin), items.begin() + static_cast<std::ptrdiff_t>(end),
              [axis](const Item& a, const Item& b) {
                return std::tie(a.middle[axis], a.surface.object, a.surface.part) <
                       std::tie(b.middle[axis], b.surface.object, b.surface.part);
              });
  };
  double least = kInfinity;
  int best_axis = 0;
  std::size_t cut = begin + count / 2;
  std::vector<double> area_from(count);  // of items[begin + i, end)
  for (int axis = 0; axis < 3; ++axis) {
    sort_along(axis);
    Aabb box = items[end - 1].box;
    for (std::size_t i = count; i-- > 0;) {
      box = united(box, items[begin + i].box);
      area_from[i] = half_area(box);
    }
    box = items[begin].box;
    for (std::size_t left = 1; left < count; ++left) {
      box = united(box, items[begin + left - 1].box);
      if (level >= kHalvingLevel && left != count / 2) continue;
      const double cost =
          half_area(box) * static_cast<double>(left) + area_from[left] * static_cast<double>(count - left);
      if (cost < least) {
        least = cost;
        best_axis = axis;
        cut = begin + left;
      }
    }
  }
  sort_along(best_axis);
  nodes_[index].axis = best_axis;
  build(items, begin, cut, level + 1);
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  build(items, cut, end, level + 1);
}

// Calls visit(surface) for each surface in a box that the ray may meet before `limit`, which visit may lower; ends when
// visit returns false.
template <class Visit>
void BoundingVolumes::walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const {
  if (nodes_.empty()) return;
  const RayBoxTest test(ray);
  std::array<std::uint32_t, kStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t index = stack[--waiting];
    const Node& node = nodes_[index];
    ++tests.volumes;
    if (!test.meets(node.box, beyond(limit))) continue;
    for (std::uint32_t i = 0; i < node.count; ++i) {
      ++tests.surfaces;
      if (!visit(bounded_[node.first + i])) return;
    }
    if (node.count > 0) continue;
    const bool second_is_nearer = ray.direction[node.axis] < 0;  // a guess, for speed only
    stack[waiting++] = second_is_nearer ? index + 1 : node.first;
    stack[waiting++] = second_is_nearer ? node.first : index + 1;
  }
}

Nearest BoundingVolumes::nearest(const Ray& ray) const {
  NearestSearch search(scene(), ray);
  for (const Surface& surface : unbounded_) search.try_counted(surface);
  walk(ray, search.answer().tests, search.limit(), [&](const Surface& surface) {
    search.try_surface(surface);
    return true;
  });
  return search.answer();
}

Obstruction BoundingVolumes::obstruction(const Ray& ray) const {
  ObstructionSearch search(scene(), ray);
  if (search.any_blocks(unbounded_)) return search.answer();
  walk(ray, search.answer().tests, ray.t_max, [&](const Surface& surface) { return !search.blocks(surface); });
  return search.answer();
}

}  // namespace etendue
