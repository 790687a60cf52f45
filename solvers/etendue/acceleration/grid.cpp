// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/grid.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/acceleration/mailbox.hpp"
#include "etendue/acceleration/search.hpp"
#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Voxels a surface: with fewer, voxels are crowded; with more, most are empty.
constexpr double kVoxelsPerSurface = 2;
constexpr int kMostDivisions = 512;

/// Where a ray enters and leaves a box; empty where it misses it. Plain rounding: the caller's margin pays.
struct Way {
  double first, last;
};
Way way_through(const Ray& ray, const Aabb& box) {
  Way way{std::max(0.0, ray.t_min), ray.t_max};
  for (int k = 0; k < 3; ++k) {
    const double d = ray.direction[k];
    if (d == 0) {
      if (ray.origin[k] < box.low[k] || ray.origin[k] > box.high[k]) return {1, 0};
      continue;
    }
    const double one = (box.low[k] - ray.origin[k]) / d, two = (box.high[k] - ray.origin[k]) / d;
    way.first = std::max(way.first, std::min(one, two));
    way.last = std::min(way.last, std::max(one, two));
  }
  return way;
}

/// As cubic voxels as can be, about kVoxelsPerSurface · count of them.
Grid::Divisions divisions_for(const Aabb& box, std::size_t count) {
  const Vec3 size = (box.high - box.low).cwiseMax((box.high - box.low).maxCoeff() * 0x1p-10);
  const double edge = std::cbrt(size.prod() / (kVoxelsPerSurface * static_cast<double>(count)));
  Grid::Divisions divisions{};
  for (int k = 0; k < 3; ++k) {
    divisions[static_cast<std::size_t>(k)] =
        static_cast<int>(std::clamp(std::round(size[k] / edge), 1.0, double{kMostDivisions}));
  }
  return divisions;
}

}  // namespace

Grid::Grid(const Scene& scene) : Grid(scene, Divisions{0, 0, 0}) {}

Grid::Grid(const Scene& scene, const Divisions& divisions)
    : Accelerator(scene), divisions_(divisions), owner_(Mailbox::unused_owner()) {
  for (const Surface& surface : surfaces(scene)) {
    const auto box = bounds(scene, surface);
    if (!box) {
      unbounded_.push_back(surface);
      continue;
    }
    bounded_.push_back(surface);
    boxes_.push_back(*box);
    box_ = united(box_, *box);
  }
  if (bounded_.empty()) return;
  // A flat scene has voxels, too.
  const double thinnest = 0x1p-10 * (box_.high - box_.low).maxCoeff();
  for (int k = 0; k < 3; ++k) {
    if (box_.high[k] - box_.low[k] < thinnest) box_.high[k] = box_.low[k] + thinnest;
  }
  if (divisions_[0] < 1) divisions_ = divisions_for(box_, bounded_.size());
  require(divisions_[1] >= 1 && divisions_[2] >= 1, "Grid: every axis has a voxel");
  for (int k = 0; k < 3; ++k) edge_[k] = (box_.high[k] - box_.low[k]) / divisions_[static_cast<std::size_t>(k)];
  list_surfaces();
}

std::size_t Grid::voxel(const std::array<int, 3>& place) const {
  return (static_cast<std::size_t>(place[2]) * static_cast<std::size_t>(divisions_[1]) +
          static_cast<std::size_t>(place[1])) *
             static_cast<std::size_t>(divisions_[0]) +
         static_cast<std::size_t>(place[0]);
}

std::array<int, 2> Grid::range(int k, double low, double high) const {
  const double last = divisions_[static_cast<std::size_t>(k)] - 1;
  const auto place = [&](double x) {
    return static_cast<int>(std::clamp(std::floor((x - box_.low[k]) / edge_[k]), 0.0, last));
  };
  return {place(low), place(high)};
}

void Grid::list_surfaces() {
  const auto each_voxel = [&](std::size_t i, auto visit) {
    std::array<std::array<int, 2>, 3> ranges;
    for (int k = 0; k < 3; ++k) {
      const double margin = kGridMargin * edge_[k];
      ranges[static_cast<std::size_t>(k)] = range(k, boxes_[i].low[k] - margin, boxes_[i].high[k] + margin);
    }
    for (int z = ranges[2][0]; z <= ranges[2][1]; ++z) {
      for (int y = ranges[1][0]; y <= ranges[1][1]; ++y) {
        for (int x = ranges[0][0]; x <= ranges[0][1]; ++x) visit(voxel({x, y, z}));
      }
    }
  };
  first_.assign(voxel({divisions_[0] - 1, divisions_[1] - 1, divisions_[2] - 1}) + 2, 0);
  for (std::size_t i = 0; i < bounded_.size(); ++i) each_voxel(i, [&](std::size_t v) { ++first_[v + 1]; });
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  listed_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < bounded_.size(); ++i) {
    each_voxel(i, [&](std::size_t v) { listed_[next[v]++] = static_cast<std::uint32_t>(i); });
  }
}

// Calls visit(surface) for each surface of each voxel along the ray, until visit returns false or `limit`, which it may
// lower, lies before the end of the voxel.
template <class Visit>
void Grid::walk(const Ray& ray, TestCount& tests, const double& limit, Visit visit) const {
  if (bounded_.empty()) return;
  Mailbox& mailbox = Mailbox::for_ray(owner_, bounded_.size());
  const auto try_listed = [&](std::uint32_t index) {
    if (!mailbox.first_time(index)) return true;
    ++tests.surfaces;
    return visit(bounded_[index]);
  };
  // The walk's points err by a few roundings of the coordinates and of the way to the box's far end.
  const Way way = way_through(ray, {box_.low - kGridMargin * edge_, box_.high + kGridMargin * edge_});
  if (!(way.first <= way.last)) return;
  const double reach =
      ray.origin.lpNorm<Eigen::Infinity>() + box_.low.lpNorm<Eigen::Infinity>() + box_.high.lpNorm<Eigen::Infinity>();
  if (reach * 0x1p-44 > kGridMargin * edge_.minCoeff()) {
    for (std::uint32_t index = 0; index < bounded_.size(); ++index) {
      if (!try_listed(index)) return;
    }
    return;
  }
  const Vec3 start = ray.at(way.first);
  std::array<int, 3> place{}, step{};
  Vec3 next, stride;  // t of the next voxel along each axis, and from one to the next
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double d = ray.direction[k];
    place[axis] = range(k, start[k], start[k])[0];
    step[axis] = d > 0 ? 1 : d < 0 ? -1 : 0;
    stride[k] = d == 0 ? kInfinity : std::abs(edge_[k] / d);
    const double face = box_.low[k] + (place[axis] + (d > 0 ? 1 : 0)) * edge_[k];
    next[k] = d == 0 ? kInfinity : (face - ray.origin[k]) / d;
  }
  while (true) {
    ++tests.voxels;
    const std::size_t here = voxel(place);
    for (std::uint32_t k = first_[here]; k < first_[here + 1]; ++k) {
      if (!try_listed(listed_[k])) return;
    }
    int axis = 0;
    const double leaves = next.minCoeff(&axis);
    // What is hit before the ray leaves this voxel, by more than the walk may err, is the nearest.
    const double margin = kGridMargin * stride.minCoeff();
    if (limit < leaves - margin || leaves > way.last) return;
    const auto k = static_cast<std::size_t>(axis);
    place[k] += step[k];
    if (place[k] < 0 || place[k] >= divisions_[k]) return;
    next[axis] += stride[axis];
  }
}

Nearest Grid::nearest(const Ray& ray) const {
  NearestSearch search(scene(), ray);
  for (const Surface& surface : unbounded_) search.try_counted(surface);
  walk(ray, search.tests(), search.limit(), [&](const Surface& surface) {
    search.try_surface(surface);
    return true;
  });
  return search.answer();
}

Obstruction Grid::obstruction(const Ray& ray) const {
  ObstructionSearch search(scene(), ray);
  if (search.any_blocks(unbounded_)) return search.answer();
  walk(ray, search.tests(), ray.t_max, [&](const Surface& surface) { return !search.blocks(surface); });
  return search.answer();
}

}  // namespace etendue
