// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/bounding_volumes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "etendue/acceleration/box_tree.hpp"
#include "etendue/acceleration/search.hpp"

namespace etendue {

namespace {

using Four = float __attribute__((vector_size(16)));
using FourMask = std::int32_t __attribute__((vector_size(16)));

constexpr std::size_t kWidth = BoundingVolumes::kWidth;
/// Surfaces of a leaf: testing few costs less than the boxes around each.
constexpr std::uint32_t kLeafSurfaces = 4;
/// Each level of the tree waits with three nodes at most.
constexpr std::size_t kStack = (kWidth - 1) * BoxTree::kDeepest + kWidth;
constexpr float kFarthest = std::numeric_limits<float>::max();

/// Of the sizes involved: eight roundings to single precision, NOTES.md.
constexpr double kSingleMargin = 0x1p-20;
/// Of the coordinates: kTriangleShift and double's own roundings, as in RayBoxTest.
constexpr double kDoubleMargin = 0x1p-48;

float rounded_down(double value) {
  const auto single = static_cast<float>(value);
  return static_cast<double>(single) > value ? std::nextafter(single, -kFarthest) : single;
}
float rounded_up(double value) {
  return -rounded_down(-value);
}

Four all(float value) {
  return Four{value, value, value, value};
}
Four four(const std::array<float, kWidth>& values) {
  return Four{values[0], values[1], values[2], values[3]};
}
/// The second where the first is not a number.
Four larger(const Four& a, const Four& b) {
  return a > b ? a : b;
}
Four smaller(const Four& a, const Four& b) {
  return a < b ? a : b;
}

/// The ray as the boxes see it: from its entry into the scene on, its largest component being 1.
class SingleRay {
 public:
  SingleRay(const Ray& ray, const Aabb& box, const Vec3& middle) {
    speed_ = ray.direction.lpNorm<Eigen::Infinity>();
    const Vec3 size = (box.high - box.low) / 2;
    // Where the ray comes near the scene: a rounded number serves, the margin pays for it.
    start_ = std::max({0.0, ray.t_min, entry(ray, box)});
    const Vec3 at_start = ray.at(start_) - middle;
    const double far = box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff();
    const double reach = ray.origin.lpNorm<Eigen::Infinity>() + far;
    margin_ = kSingleMargin * (size.maxCoeff() + at_start.lpNorm<Eigen::Infinity>()) + kDoubleMargin * 4 * reach;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      origin_[axis] = all(static_cast<float>(at_start[k]));
      inverse_[axis] = all(static_cast<float>(speed_ / ray.direction[k]));
      forward_[axis] = inverse_[axis][0] > 0;  // of 0 and −0, too
    }
    room_ = all(rounded_up(margin_));
  }

  /// Upper bound, in the boxes' units, on where hits up to t lie.
  float until(double t) const {
    const double way = (t - start_) * speed_ * (1 + kDoubleMargin) + 2 * margin_;
    return way < static_cast<double>(kFarthest) ? rounded_up(way) : kFarthest;
  }

  /// Where the ray enters each of the four boxes; beyond `last` where it does not before that.
  Four enters(const BoundingVolumes::Node& node, float last) const {
    Four near = -room_, far = all(last);
    for (std::size_t k = 0; k < 3; ++k) {
      const Four low = (four(node.low[k]) - room_ - origin_[k]) * inverse_[k];
      const Four high = (four(node.high[k]) + room_ - origin_[k]) * inverse_[k];
      // Where 0 · ∞ is not a number, the interval stays as it is.
      near = larger(forward_[k] ? low : high, near);
      far = smaller(forward_[k] ? high : low, far);
    }
    return near <= far + room_ ? near : all(std::numeric_limits<float>::infinity());
  }

 private:
  static double entry(const Ray& ray, const Aabb& box) {
    double first = 0;
    for (int k = 0; k < 3; ++k) {
      const double d = ray.direction[k];
      if (d == 0) continue;
      const double t = ((d > 0 ? box.low[k] : box.high[k]) - ray.origin[k]) / d;
      first = std::max(first, t);
    }
    return std::isfinite(first) ? first : 0;
  }

  std::array<Four, 3> origin_, inverse_;
  std::array<bool, 3> forward_;
  Four room_;
  double start_ = 0, speed_ = 1, margin_ = 0;
};

double half_area(const Aabb& box) {
  const Vec3 edge = box.high - box.low;
  return edge.x() * edge.y() + edge.y() * edge.z() + edge.z() * edge.x();
}

/// Makes nodes of four from a tree of two.
class Widener {
 public:
  Widener(const BoxTree& tree, const Vec3& middle, std::vector<BoundingVolumes::Node>& nodes)
      : tree_(tree), middle_(middle), nodes_(nodes), counts_(tree.nodes.size()) {
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
      const auto& node = tree.nodes[i];
      counts_[i] = node.count > 0 ? node.count : counts_[i + 1] + counts_[node.first];
    }
  }

  void widen(std::uint32_t root) {
    std::array<std::uint32_t, kWidth> parts{root};
    std::size_t count = 1;
    while (count < kWidth) {
      std::size_t largest = kWidth;
      for (std::size_t k = 0; k < count; ++k) {
        if (is_leaf(parts[k])) continue;
        if (largest == kWidth || half_area(tree_.nodes[parts[k]].box) > half_area(tree_.nodes[parts[largest]].box)) {
          largest = k;
        }
      }
      if (largest == kWidth) break;
      const std::uint32_t opened = parts[largest];
      parts[largest] = opened + 1;
      parts[count++] = tree_.nodes[opened].first;
    }
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    for (std::size_t k = 0; k < kWidth; ++k) {
      set_box(nodes_[index], k, k < count ? tree_.nodes[parts[k]].box : Aabb{});
      nodes_[index].first[k] = 0;
      nodes_[index].count[k] = 0;
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (is_leaf(parts[k])) {
        nodes_[index].first[k] = first_surface(parts[k]);
        nodes_[index].count[k] = counts_[parts[k]];
      } else {
        nodes_[index].first[k] = static_cast<std::uint32_t>(nodes_.size());
        widen(parts[k]);
      }
    }
  }

 private:
  bool is_leaf(std::uint32_t i) const { return counts_[i] <= kLeafSurfaces; }

  std::uint32_t first_surface(std::uint32_t i) const {
    while (tree_.nodes[i].count == 0) ++i;  // down the first children
    return tree_.nodes[i].first;
  }

  void set_box(BoundingVolumes::Node& node, std::size_t k, const Aabb& box) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      node.low[a][k] = box.empty() ? kFarthest : rounded_down(box.low[axis] - middle_[axis]);
      node.high[a][k] = box.empty() ? -kFarthest : rounded_up(box.high[axis] - middle_[axis]);
    }
  }

  const BoxTree& tree_;
  const Vec3 middle_;
  std::vector<BoundingVolumes::Node>& nodes_;
  std::vector<std::uint32_t> counts_;  // surfaces below each node of the tree
};

const Triangle* triangle_of(const Scene& scene, const Surface& surface, Triangle& made) {
  const Shape& shape = scene.objects[surface.object].shape;
  if (const auto* mesh = std::get_if<Mesh>(&shape)) made = mesh->triangle(surface.part);
  return std::holds_alternative<Mesh>(shape) ? &made : std::get_if<Triangle>(&shape);
}

}  // namespace

BoundingVolumes::BoundingVolumes(const Scene& scene) : Accelerator(scene) {
  BoxTree tree(scene);
  bounded_ = std::move(tree.bounded);
  unbounded_ = std::move(tree.unbounded);
  if (tree.nodes.empty()) return;
  box_ = tree.nodes.front().box;
  middle_ = box_.centre();
  Widener(tree, middle_, nodes_).widen(0);
  is_triangle_.assign(bounded_.size() / 32 + 1, 0);
  triangles_.resize(bounded_.size());
  bool any = false;
  for (std::size_t i = 0; i < bounded_.size(); ++i) {
    Triangle made;
    const Triangle* triangle = triangle_of(scene, bounded_[i], made);
    if (!triangle) continue;
    triangles_[i] = *triangle;
    is_triangle_[i / 32] |= 1U << i % 32;
    any = true;
  }
  if (!any) triangles_ = {};
}

// Calls visit(surface) for each surface in a box that the ray may meet before `limit`, which visit may lower; ends when
// visit returns false. Triangles that the ray passes are left out.
template <class Visit>
void BoundingVolumes::walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const {
  if (nodes_.empty()) return;
  const SingleRay single(ray, box_, middle_);
  const TrianglePass pass(ray);
  const auto visit_leaf = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      ++tests.surfaces;
      const bool triangle = is_triangle_[i / 32] >> i % 32 & 1U;
      if (triangle && !pass.may_hit(triangles_[i], limit)) continue;
      if (!visit(bounded_[i])) return false;
    }
    return true;
  };
  // Memory is what a large scene waits for: all that may be looked at next is asked for at once.
  const auto fetch = [&](std::uint32_t first, std::uint32_t count) {
    const auto* place = count > 0 && !triangles_.empty()
                            ? reinterpret_cast<const char*>(&triangles_[first])
                            : reinterpret_cast<const char*>(&nodes_[count > 0 ? 0 : first]);
    for (std::size_t line = 0; line < sizeof(Node); line += 64) __builtin_prefetch(place + line);
  };
  struct Waiting {
    std::uint32_t first, count;
    float enters;
  };
  std::array<Waiting, kStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, 0, 0};
  float last = single.until(limit);
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.enters > last) continue;
    if (next.count > 0) {
      if (!visit_leaf(next.first, next.count)) return;
      last = single.until(limit);
      continue;
    }
    const Node& node = nodes_[next.first];
    tests.volumes += kWidth;
    const Four enters = single.enters(node, last);
    const std::size_t below = waiting;
    for (std::size_t k = 0; k < kWidth; ++k) {
      if (!(enters[k] <= last)) continue;
      // The nearest ends on top: an insertion among three at most.
      std::size_t place = waiting++;
      for (; place > below && stack[place - 1].enters < enters[k]; --place) stack[place] = stack[place - 1];
      stack[place] = {node.first[k], node.count[k], enters[k]};
      fetch(node.first[k], node.count[k]);
    }
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
