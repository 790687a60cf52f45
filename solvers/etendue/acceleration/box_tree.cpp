// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/box_tree.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// Up to here testing the surfaces costs less than testing boxes around them.
constexpr std::size_t kLeafSurfaces = 2;
/// From this level on groups are halved, so that no tree is deeper than this plus log2 of the number of surfaces.
constexpr int kHalvingLevel = 40;
constexpr std::size_t kBins = 16;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Item {
  Aabb box;
  Vec3 middle;
  std::uint32_t surface;  // in the order of surfaces()
};
using Items = std::vector<Item>;

double half_area(const Aabb& box) {
  const Vec3 edge = box.high - box.low;
  return edge.x() * edge.y() + edge.y() * edge.z() + edge.z() * edge.x();
}

/// Where a group is cut: items whose bin along `axis` is below `bin` go to the left.
struct Cut {
  int axis = -1;
  std::size_t bin = 0;
  double cost = kInfinity;
};

class Group {
 public:
  Group(Items& items, std::size_t begin, std::size_t end) : items_(items), begin_(begin), end_(end) {
    for (std::size_t i = begin; i < end; ++i) {
      box_ = united(box_, items[i].box);
      middles_ = united(middles_, items[i].middle);
    }
  }

  const Aabb& box() const { return box_; }
  std::size_t count() const { return end_ - begin_; }

  /// Divides the group at the cheapest place, or in halves; returns where, and along which axis.
  std::pair<std::size_t, int> divide(bool in_halves) {
    Cut best;
    for (int axis = 0; axis < 3 && !in_halves; ++axis) {
      if (middles_.low[axis] < middles_.high[axis]) consider(axis, best);
    }
    if (best.axis < 0) return halve();
    const auto cut =
        std::partition(at(begin_), at(end_), [&](const Item& item) { return bin_of(item, best.axis) < best.bin; });
    const auto middle = static_cast<std::size_t>(cut - items_.begin());
    return {middle, best.axis};
  }

 private:
  Items::iterator at(std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); }

  std::size_t bin_of(const Item& item, int axis) const {
    const double share = (item.middle[axis] - middles_.low[axis]) / (middles_.high[axis] - middles_.low[axis]);
    return std::min(kBins - 1, static_cast<std::size_t>(share * kBins));
  }

  void consider(int axis, Cut& best) const {
    std::array<Aabb, kBins> boxes;
    std::array<std::size_t, kBins> counts{};
    for (std::size_t i = begin_; i < end_; ++i) {
      const std::size_t bin = bin_of(items_[i], axis);
      boxes[bin] = united(boxes[bin], items_[i].box);
      ++counts[bin];
    }
    std::array<double, kBins> cost_right{};
    Aabb box;
    std::size_t count = 0;
    for (std::size_t bin = kBins; bin-- > 1;) {
      box = united(box, boxes[bin]);
      count += counts[bin];
      cost_right[bin] = count == 0 ? kInfinity : half_area(box) * static_cast<double>(count);
    }
    box = {};
    count = 0;
    for (std::size_t bin = 1; bin < kBins; ++bin) {
      box = united(box, boxes[bin - 1]);
      count += counts[bin - 1];
      if (count == 0) continue;
      const double cost = half_area(box) * static_cast<double>(count) + cost_right[bin];
      if (cost < best.cost) best = {axis, bin, cost};
    }
  }

  std::pair<std::size_t, int> halve() {
    int axis = 0;
    (middles_.high - middles_.low).maxCoeff(&axis);
    const std::size_t middle = begin_ + count() / 2;
    std::nth_element(at(begin_), at(middle), at(end_), [axis](const Item& a, const Item& b) {
      return std::tie(a.middle[axis], a.surface) < std::tie(b.middle[axis], b.surface);
    });
    return {middle, axis};
  }

  Items& items_;
  std::size_t begin_, end_;
  Aabb box_, middles_;
};

class Builder {
 public:
  Builder(BoxTree& tree, const std::vector<Surface>& all, Items& items) : tree_(tree), all_(all), items_(items) {}

  void build(std::size_t begin, std::size_t end, int level) {
    Group group(items_, begin, end);
    const std::size_t index = tree_.nodes.size();
    tree_.nodes.push_back({group.box(), 0, 0, 0});
    if (group.count() <= kLeafSurfaces) {
      tree_.nodes[index].first = static_cast<std::uint32_t>(tree_.bounded.size());
      tree_.nodes[index].count = static_cast<std::uint32_t>(group.count());
      for (std::size_t i = begin; i < end; ++i) tree_.bounded.push_back(all_[items_[i].surface]);
      return;
    }
    const auto [cut, axis] = group.divide(level >= kHalvingLevel);
    tree_.nodes[index].axis = axis;
    build(begin, cut, level + 1);
    tree_.nodes[index].first = static_cast<std::uint32_t>(tree_.nodes.size());
    build(cut, end, level + 1);
  }

 private:
  BoxTree& tree_;
  const std::vector<Surface>& all_;
  Items& items_;
};

}  // namespace

BoxTree::BoxTree(const Scene& scene, const std::vector<Surface>& all) {
  require(all.size() < (std::size_t{1} << 31), "BoxTree: fewer than 2^31 surfaces");
  Items items;
  items.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto box = bounds(scene, all[i]);
    if (box) {
      items.push_back({*box, box->centre(), static_cast<std::uint32_t>(i)});
    } else {
      unbounded.push_back(all[i]);
    }
  }
  if (items.empty()) return;
  nodes.reserve(2 * items.size());
  bounded.reserve(items.size());
  Builder(*this, all, items).build(0, items.size(), 0);
}

}  // namespace etendue
