// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/wide_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "etendue/acceleration/box_tree.hpp"
#include "etendue/acceleration/single_ray.hpp"

namespace etendue {

namespace {

constexpr std::size_t kWidth = WideTree::kWidth;
constexpr std::size_t kLeaf = WideTree::kLeaf;
constexpr double kLargestByte = 255;

double half_area(const Aabb& box) {
  const Vec3 edge = box.high - box.low;
  return edge.x() * edge.y() + edge.y() * edge.z() + edge.z() * edge.x();
}

/// What parts of a tree of two become nodes of eight: the choice of least expected cost, a node and a leaf costing the same
/// each time that a random ray comes to them.
///
/// Source    Ylitie, Karras and Laine 2017 (the table of costs)
class Choice {
 public:
  explicit Choice(const BoxTree& tree) : tree_(tree), counts_(tree.nodes.size()), cost_(tree.nodes.size()) {
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
      const auto& node = tree.nodes[i];
      const double area = half_area(node.box);
      counts_[i] = node.count > 0 ? node.count : counts_[i + 1] + counts_[node.first];
      if (counts_[i] <= kLeaf) {
        cost_[i].fill(area);
        continue;
      }
      cost_[i][0] = area + division(i, kWidth).cost;
      for (std::size_t parts = 2; parts < kWidth; ++parts) {
        cost_[i][parts - 1] = std::min(cost_[i][parts - 2], division(i, parts).cost);
      }
    }
  }

  std::uint32_t count(std::uint32_t i) const { return counts_[i]; }
  bool is_leaf(std::uint32_t i) const { return counts_[i] <= kLeaf; }

  struct Parts {
    std::array<std::uint32_t, kWidth> root;
    std::size_t count = 0;
  };
  /// Of a node of eight around this one.
  Parts parts_of(std::uint32_t i) const {
    Parts parts;
    if (is_leaf(i)) {
      parts.root[parts.count++] = i;
    } else {
      divide(i, kWidth, parts);
    }
    return parts;
  }

 private:
  struct Division {
    std::size_t first = 1;  // parts of the first child
    double cost = 0;
  };
  /// The cheapest way to make `parts` parts, at most, of the children of i.
  Division division(std::size_t i, std::size_t parts) const {
    Division best;
    for (std::size_t first = 1; first < parts; ++first) {
      const double cost = cost_[i + 1][first - 1] + cost_[tree_.nodes[i].first][parts - first - 1];
      if (first == 1 || cost < best.cost) best = {first, cost};
    }
    return best;
  }

  void divide(std::uint32_t i, std::size_t parts, Parts& result) const {
    const Division best = division(i, parts);
    gather(i + 1, best.first, result);
    gather(tree_.nodes[i].first, parts - best.first, result);
  }
  void gather(std::uint32_t i, std::size_t parts, Parts& result) const {
    while (parts > 1 && cost_[i][parts - 1] == cost_[i][parts - 2]) --parts;
    if (parts > 1) return divide(i, parts, result);
    result.root[result.count++] = i;
  }

  const BoxTree& tree_;
  std::vector<std::uint32_t> counts_;                 // surfaces below each node of the tree
  std::vector<std::array<double, kWidth - 1>> cost_;  // of each node, as at most so many parts
};

/// Makes nodes of eight from a tree of two.
class Widener {
 public:
  Widener(const Scene& scene, const BoxTree& from, WideTree& to) : scene_(scene), from_(from), to_(to), choice_(from) {
    std::size_t leaves = 1;
    for (std::uint32_t i = 0; i < from.nodes.size(); ++i) {
      if (choice_.is_leaf(i)) continue;
      leaves += (choice_.is_leaf(i + 1) ? 1U : 0U) + (choice_.is_leaf(from.nodes[i].first) ? 1U : 0U);
    }
    to_.members.reserve(leaves * kLeaf);
    to_.corners.reserve(leaves);
  }

  /// Parts of one node lie side by side.
  void widen() {
    to_.nodes.emplace_back();
    fill(0, 0);
  }

 private:
  void fill(std::size_t index, std::uint32_t root) {
    const Choice::Parts parts = choice_.parts_of(root);
    WideTree::Node node{};
    node.first_node = static_cast<std::uint32_t>(to_.nodes.size());
    node.first_leaf = static_cast<std::uint32_t>(to_.members.size() / kLeaf);
    set_frame(node, from_.nodes[root].box);
    unsigned nodes = 0, leaves = 0;
    for (std::size_t k = 0; k < parts.count; ++k) {
      set_box(node, k, from_.nodes[parts.root[k]].box);
      if (choice_.is_leaf(parts.root[k])) {
        const bool triangles = add_leaf(parts.root[k]);
        node.part[k] = static_cast<std::uint8_t>((triangles ? WideTree::kTriangles : 0U) | leaves++ << 3 |
                                                 choice_.count(parts.root[k]));
      } else {
        node.part[k] = static_cast<std::uint8_t>(WideTree::kInner | nodes++ << 3);
        to_.nodes.emplace_back();
      }
    }
    to_.nodes[index] = node;
    for (std::size_t k = 0; k < parts.count; ++k) {
      if (!choice_.is_leaf(parts.root[k])) fill(node.first_node + WideTree::offset_of(node.part[k]), parts.root[k]);
    }
  }

  double local(double coordinate, int axis) const { return (coordinate - to_.middle[axis]) * to_.unit; }

  void set_frame(WideTree::Node& node, const Aabb& box) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      node.origin[a] = rounded_down(local(box.low[axis], axis));
      const double extent = local(box.high[axis], axis) - static_cast<double>(node.origin[a]);
      int exponent = -100;  // far below what the margins forgive
      if (extent > 0) exponent = std::max(exponent, std::ilogb(extent / kLargestByte) + 1);
      node.step[a] = std::ldexp(1.0F, exponent);
    }
  }

  void set_box(WideTree::Node& node, std::size_t k, const Aabb& box) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double step = static_cast<double>(node.step[a]), origin = static_cast<double>(node.origin[a]);
      const auto byte = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, kLargestByte)); };
      node.low[a][k] = byte(std::floor((local(box.low[axis], axis) - origin) / step));
      node.high[a][k] = byte(std::ceil((local(box.high[axis], axis) - origin) / step));
    }
  }

  /// Whether all of its surfaces are triangles.
  bool add_leaf(std::uint32_t root) {
    std::uint32_t i = root;
    while (from_.nodes[i].count == 0) ++i;  // down the first children
    const std::uint32_t first = from_.nodes[i].first, count = choice_.count(root);
    bool all = true;
    for (std::uint32_t k = 0; k < kLeaf; ++k) {
      const Surface& surface = from_.bounded[first + std::min(k, count - 1)];
      const auto triangle = triangle_of(scene_, surface);
      to_.members.push_back({triangle.value_or(Triangle{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}), surface});
      all = all && triangle;
    }
    if (all) set_corners(to_.members.size() / kLeaf - 1);
    return all;
  }

  void set_corners(std::size_t leaf) {
    to_.corners.resize(leaf + 1);
    for (std::size_t k = 0; k < kLeaf; ++k) {
      const Triangle& triangle = to_.members[leaf * kLeaf + k].triangle;
      const std::array<const Vec3*, 3> corner{&triangle.a, &triangle.b, &triangle.c};
      for (std::size_t c = 0; c < 3; ++c) {
        for (int axis = 0; axis < 3; ++axis) {
          to_.corners[leaf].at[c][static_cast<std::size_t>(axis)][k] = to_single(local((*corner[c])[axis], axis));
        }
      }
    }
  }

  const Scene& scene_;
  const BoxTree& from_;
  WideTree& to_;
  const Choice choice_;
};

}  // namespace

std::optional<Triangle> triangle_of(const Scene& scene, const Surface& surface) {
  const Shape& shape = scene.objects[surface.object].shape;
  if (moves(scene, scene.objects[surface.object])) return std::nullopt;
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->triangle(surface.part);
  if (const auto* triangle = std::get_if<Triangle>(&shape)) return *triangle;
  return std::nullopt;
}

WideTree::WideTree(const Scene& scene, const std::vector<Surface>& all) {
  BoxTree tree(scene, all);
  unbounded = std::move(tree.unbounded);
  if (tree.nodes.empty()) return;
  box = tree.nodes.front().box;
  middle = box.centre();
  const double half = ((box.high - box.low) / 2).maxCoeff();
  unit = half > 0 ? std::ldexp(1.0, -std::ilogb(half) - 1) : 1;
  Widener(scene, tree, *this).widen();
}

}  // namespace etendue
