// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/bounding_volumes.hpp"

#include "etendue/acceleration/box_tree.hpp"
#include "etendue/acceleration/search.hpp"
#include "etendue/acceleration/single_ray.hpp"

namespace etendue {

namespace {

constexpr std::size_t kWidth = WideTree::kWidth;
constexpr std::size_t kLeaf = WideTree::kLeaf;
/// Each level of the tree waits with seven parts at most.
constexpr std::size_t kStack = (kWidth - 1) * BoxTree::kDeepest + kWidth;

/// Memory is what a large scene waits for: all that may be looked at next is asked for at once.
void fetch(const void* place, std::size_t bytes) {
  for (std::size_t line = 0; line < bytes; line += 64) __builtin_prefetch(static_cast<const char*>(place) + line);
}

/// What a walk does with the surfaces that it comes to; `limit` is where hits stop to matter.
struct NearestVisit {
  NearestSearch& search;
  double limit() const { return search.limit(); }
  bool try_triangle(const Triangle& triangle, const Surface& surface) const {
    search.try_triangle(triangle, surface);
    return true;
  }
  bool try_surface(const Surface& surface) const {
    search.try_surface(surface);
    return true;
  }
};
struct ObstructionVisit {
  ObstructionSearch& search;
  double until;
  double limit() const { return until; }
  bool try_triangle(const Triangle& triangle, const Surface&) const { return !search.blocks(triangle); }
  bool try_surface(const Surface& surface) const { return !search.blocks(surface); }
};

}  // namespace

BoundingVolumes::BoundingVolumes(const Scene& scene) : BoundingVolumes(scene, surfaces(scene)) {}

BoundingVolumes::BoundingVolumes(const Scene& scene, const std::vector<Surface>& all)
    : Accelerator(scene), tree_(scene, all) {}

// Gives `visit` each surface in a box that the ray may meet before its limit, which it may lower; ends when it says no.
// Triangles that the ray passes are left out.
template <class Visit>
void BoundingVolumes::walk(const Ray& ray, TestCount& tests, Visit visit) const {
  if (tree_.nodes.empty()) return;
  const SingleRay single(ray, tree_);
  const TrianglePass pass(ray);
  float last = single.until(visit.limit());
  const auto visit_leaf = [&](std::uint32_t leaf, unsigned part) {
    const unsigned count = WideTree::count_of(part);
    tests.surfaces += count;
    const bool triangles = part & WideTree::kTriangles;
    const unsigned all = (1U << count) - 1;
    for (unsigned rest = triangles ? all & single.passed(tree_.corners[leaf], last) : all; rest; rest &= rest - 1) {
      const std::size_t i = kLeaf * leaf + static_cast<unsigned>(__builtin_ctz(rest));
      const WideTree::Member& member = tree_.members[i];
      if (!triangles) {
        if (!visit.try_surface(member.surface)) return false;
      } else if (pass.may_hit(member.triangle, visit.limit())) {
        if (!visit.try_triangle(member.triangle, member.surface)) return false;
      }
    }
    return true;
  };
  struct Waiting {
    std::uint32_t index;
    unsigned part;  // kInner: a node; else a leaf
    float where;
  };
  std::array<Waiting, kStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, WideTree::kInner, 0};
  std::array<float, kWidth> where;
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.where > last) continue;
    if (!(next.part & WideTree::kInner)) {
      if (!visit_leaf(next.index, next.part)) return;
      last = single.until(visit.limit());
      continue;
    }
    const WideTree::Node& node = tree_.nodes[next.index];
    tests.volumes += kWidth;
    const std::size_t below = waiting;
    for (unsigned rest = single.entered(node, last, where); rest; rest &= rest - 1) {
      const auto k = static_cast<std::size_t>(__builtin_ctz(rest));
      const unsigned part = node.part[k];
      if (part == 0 || !(where[k] <= last)) continue;
      const bool inner = part & WideTree::kInner;
      const std::uint32_t index = (inner ? node.first_node : node.first_leaf) + WideTree::offset_of(part);
      if (inner) fetch(&tree_.nodes[index], sizeof(WideTree::Node));
      if (part & WideTree::kTriangles && !inner) fetch(&tree_.corners[index], sizeof(WideTree::Corners));
      // The nearest ends on top: an insertion among seven at most.
      std::size_t place = waiting++;
      for (; place > below && stack[place - 1].where < where[k]; --place) stack[place] = stack[place - 1];
      stack[place] = {index, part, where[k]};
    }
  }
}

Nearest BoundingVolumes::nearest(const Ray& ray) const {
  NearestSearch search(scene(), ray);
  for (const Surface& surface : tree_.unbounded) search.try_counted(surface);
  walk(ray, search.tests(), NearestVisit{search});
  return search.answer();
}

Obstruction BoundingVolumes::obstruction(const Ray& ray) const {
  ObstructionSearch search(scene(), ray);
  if (search.any_blocks(tree_.unbounded)) return search.answer();
  walk(ray, search.tests(), ObstructionVisit{search, ray.t_max});
  return search.answer();
}

}  // namespace etendue
