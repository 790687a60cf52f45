// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/critical_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace etendue {

namespace {

/// Where the ray from `far` through `near` meets the source's plane; nothing where it does not come down.
std::optional<Vec3> project(const Vec3& far, double far_height, const Vec3& near, double near_height) {
  if (!(far_height > near_height)) return std::nullopt;
  return far + (near - far) * (far_height / (far_height - near_height));
}

class Collector {
 public:
  explicit Collector(const Loop& source) : source_(source) {}

  /// The plane through `a`, `b` and `c`, traced where the projections `p` and `q` of the event's ends lie.
  void add(const Vec3& a, const Vec3& b, const Vec3& c, const std::optional<Vec3>& p, const std::optional<Vec3>& q) {
    if (!p && !q) return;
    const Vec3 normal = (b - a).cross(c - a);
    const double size = normal.norm();
    if (!(size > 0)) return;
    lines_.push_back({normal / size, normal.dot(a) / size, p.value_or(a), q.value_or(a), p && q});
  }

  void add_plane(const std::vector<Vec3>& blocker) {
    const Vec3 normal = (blocker[1] - blocker[0]).cross(blocker[2] - blocker[0]);
    const double size = normal.norm();
    if (size > 0) lines_.push_back({normal / size, normal.dot(blocker[0]) / size, blocker[0], blocker[0], false});
  }

  /// Events between the edges and vertices of a far loop and those of a near one.
  void add_pair(std::span<const Vec3> far, std::span<const Vec3> near) {
    std::vector<double> far_heights, near_heights;
    for (const Vec3& v : far) far_heights.push_back(height_above(source_, v));
    for (const Vec3& v : near) near_heights.push_back(height_above(source_, v));
    std::vector<std::optional<Vec3>> projections;
    for (std::size_t i = 0; i < far.size(); ++i) {
      for (std::size_t j = 0; j < near.size(); ++j) {
        projections.push_back(project(far[i], far_heights[i], near[j], near_heights[j]));
      }
    }
    const auto at = [&](std::size_t i, std::size_t j) { return projections[i * near.size() + j]; };
    for (std::size_t i = 0; i < far.size(); ++i) {
      const std::size_t i_next = (i + 1) % far.size();
      for (std::size_t j = 0; j < near.size(); ++j) {
        const std::size_t j_next = (j + 1) % near.size();
        add(far[i], near[j], near[j_next], at(i, j), at(i, j_next));
        add(near[j], far[i], far[i_next], at(i, j), at(i_next, j));
      }
    }
  }

  std::vector<CriticalLine> take() { return std::move(lines_); }

 private:
  const Loop& source_;
  std::vector<CriticalLine> lines_;
};

}  // namespace

std::vector<CriticalLine> critical_lines(const Loop& source, std::span<const Vec3> receiver,
                                         std::span<const std::vector<Vec3>> blockers) {
  Collector collector(source);
  for (std::size_t i = 0; i < blockers.size(); ++i) {
    collector.add_plane(blockers[i]);
    collector.add_pair(receiver, blockers[i]);
    for (std::size_t j = 0; j < blockers.size(); ++j) {
      if (i != j) collector.add_pair(blockers[i], blockers[j]);
    }
  }
  std::vector<CriticalLine> lines = collector.take();
  std::erase_if(lines, [&](const CriticalLine& line) { return !meets(line, source.vertices); });
  return lines;
}

bool meets(const CriticalLine& line, std::span<const Vec3> cell) {
  double low = 0, high = 0, reach = 0;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& v : cell) {
    const double height = line.normal.dot(v) - line.level;
    low = std::min(low, height);
    high = std::max(high, height);
    centre += v / static_cast<double>(cell.size());
  }
  for (const Vec3& v : cell) reach = std::max(reach, (v - centre).norm());
  // A cell that has been cut along the line touches it with rounding only: that is not a crossing.
  constexpr double kTouch = 0x1p-30;
  if (std::min(-low, high) <= kTouch * reach) return false;
  if (!line.bounded) return true;
  const Vec3 along = line.end - line.start;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((centre - line.start).dot(along) / square, 0.0, 1.0) : 0;
  return (line.start + t * along - centre).norm() <= reach;
}

}  // namespace etendue
