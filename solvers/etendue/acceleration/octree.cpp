// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/octree.hpp"

#include <algorithm>
#include <array>

#include "etendue/acceleration/mailbox.hpp"
#include "etendue/acceleration/search.hpp"

namespace etendue {

namespace {

bool overlap(const Aabb& a, const Aabb& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// One of the eight halves of halves: bit k of `octant` says upper half along axis k. Neighbours share their faces.
Aabb octant_of(const Aabb& box, std::size_t octant) {
  const Vec3 middle = box.centre();
  Aabb part = box;
  for (int axis = 0; axis < 3; ++axis) {
    (octant >> axis & 1 ? part.low : part.high)[axis] = middle[axis];
  }
  return part;
}

/// Each level waits with seven voxels at most.
constexpr std::size_t kStack = 7 * 32 + 1;
constexpr int kDeepest = 30;

}  // namespace

Octree::Octree(const Scene& scene, const OctreeLimits& limits)
    : Accelerator(scene), limits_(limits), owner_(Mailbox::unused_owner()) {
  limits_.depth = std::clamp(limits_.depth, 0, kDeepest);
  Aabb whole;
  for (const Surface& surface : surfaces(scene)) {
    const auto box = bounds(scene, surface);
    if (!box) {
      unbounded_.push_back(surface);
      continue;
    }
    bounded_.push_back(surface);
    boxes_.push_back(*box);
    whole = united(whole, *box);
  }
  if (bounded_.empty()) return;
  const Vec3 half = Vec3::Constant((whole.high - whole.low).maxCoeff() / 2);
  nodes_.push_back({united(whole, Aabb{whole.centre() - half, whole.centre() + half})});
  std::vector<std::uint32_t> all(bounded_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
  divide(0, all, 0);
}

void Octree::divide(std::size_t node, const std::vector<std::uint32_t>& inside, int depth) {
  std::array<std::vector<std::uint32_t>, 8> parts;
  bool worthwhile = false;
  if (inside.size() > limits_.most_surfaces && depth < limits_.depth) {
    for (std::size_t octant = 0; octant < 8; ++octant) {
      const Aabb box = octant_of(nodes_[node].box, octant);
      for (const std::uint32_t i : inside) {
        if (overlap(box, boxes_[i])) parts[octant].push_back(i);
      }
      worthwhile = worthwhile || parts[octant].size() < inside.size();
    }
  }
  if (!worthwhile) {
    nodes_[node].first = static_cast<std::uint32_t>(listed_.size());
    nodes_[node].count = static_cast<std::uint32_t>(inside.size());
    listed_.insert(listed_.end(), inside.begin(), inside.end());
    return;
  }
  const std::size_t first = nodes_.size();
  nodes_[node].leaf = false;
  nodes_[node].first = static_cast<std::uint32_t>(first);
  for (std::size_t octant = 0; octant < 8; ++octant) nodes_.push_back({octant_of(nodes_[node].box, octant)});
  for (std::size_t octant = 0; octant < 8; ++octant) divide(first + octant, parts[octant], depth + 1);
}

// Calls visit(surface) for each surface of each voxel that the ray meets before `limit`, which visit may lower; ends
// when visit returns false.
template <class Visit>
void Octree::walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const {
  if (nodes_.empty()) return;
  Mailbox& mailbox = Mailbox::for_ray(owner_, bounded_.size());
  const RayBoxTest test(ray);
  // Octants in the order in which a ray of this direction enters them: the nearest one is that of these bits.
  std::size_t nearest_octant = 0;
  for (int axis = 0; axis < 3; ++axis) nearest_octant |= ray.direction[axis] < 0 ? std::size_t{1} << axis : 0;
  std::array<std::uint32_t, kStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const Node& node = nodes_[stack[--waiting]];
    ++tests.volumes;
    if (!test.meets(node.box, beyond(limit))) continue;
    tests.voxels += node.leaf;
    for (std::size_t k = 0; k < node.count; ++k) {
      const std::uint32_t index = listed_[node.first + k];
      if (!mailbox.first_time(index)) continue;
      ++tests.surfaces;
      if (!visit(bounded_[index])) return;
    }
    if (node.leaf) continue;
    for (std::size_t k = 8; k-- > 0;) {
      stack[waiting++] = static_cast<std::uint32_t>(node.first + (k ^ nearest_octant));
    }
  }
}

Nearest Octree::nearest(const Ray& ray) const {
  NearestSearch search(scene(), ray);
  for (const Surface& surface : unbounded_) search.try_counted(surface);
  walk(ray, search.tests(), search.limit(), [&](const Surface& surface) {
    search.try_surface(surface);
    return true;
  });
  return search.answer();
}

Obstruction Octree::obstruction(const Ray& ray) const {
  ObstructionSearch search(scene(), ray);
  if (search.any_blocks(unbounded_)) return search.answer();
  walk(ray, search.tests(), ray.t_max, [&](const Surface& surface) { return !search.blocks(surface); });
  return search.answer();
}

}  // namespace etendue
