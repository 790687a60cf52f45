// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/near_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etendue {

namespace {

/// How far something reaches along a direction.
struct Extent1 {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

/// No cut takes off less than this share: what rounding leaves of a strip is not cut for ever.
constexpr double kSliver = 0x1p-10;

double along(const Vec2& normal, const Vec2& x) {
  return normal.x() * x.y() - normal.y() * x.x();
}

}  // namespace

NearEdges::NearEdges(std::span<const Vec3> receiver, const SightZone& zone, double negligible)
    : negligible_(negligible) {
  Extent1 x, y;
  for (const Vec2& v : zone.corners) {
    x.add(v.x());
    y.add(v.y());
  }
  const double size = std::max(x.high - x.low, y.high - y.low);
  const auto add_loop = [&](std::span<const Vec3> loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0], size);
  };
  add_loop(receiver);
  for (const Outline& outline : zone.outlines) add_loop(outline);
}

void NearEdges::add(const Vec3& a, const Vec3& b, double size) {
  // Below an edge in the source's own plane nothing happens at all, and a steep one is near at its end only, where
  // integrate() collapses its nodes.
  const double lowest = std::min(a.z(), b.z()), highest = std::max(a.z(), b.z());
  if (!(highest > 0) || lowest * kStrip > size) return;
  const Vec2 way = (b - a).head<2>();
  const double length = way.norm();
  if (!(length > std::abs(b.z() - a.z()))) return;
  const Vec2 normal(way.y() / length, -way.x() / length);
  Edge edge{normal, normal.dot(a.head<2>()), along(normal, a.head<2>()), 0, (b.z() - a.z()) / length, 0};
  edge.end = edge.begin + length;
  edge.from = a.z() - edge.rise * edge.begin;
  edges_.push_back(edge);
}

std::optional<double> NearEdges::cut_level(const Edge& edge, const Cell& cell) const {
  Extent1 across, over;
  for (const Vec2& corner : cell.corners()) {
    across.add(edge.normal.dot(corner) - edge.level);
    over.add(along(edge.normal, corner));
  }
  const double begin = std::max(edge.begin, over.low), end = std::min(edge.end, over.high);
  if (!(begin < end)) return std::nullopt;
  const double height = edge.from + edge.rise * (edge.rise > 0 ? end : begin);
  const double near = across.low < 0 && across.high > 0 ? 0 : std::min(std::abs(across.low), std::abs(across.high));
  const double far = std::max(std::abs(across.low), std::abs(across.high));
  // A strip cut to its width is not cut again for a rounding.
  if (far <= (1 + kSliver) * kStrip * std::max(near, height) || far * (end - begin) <= negligible_) return std::nullopt;
  // A cell on both sides is cut below the edge first.
  if (near == 0 && std::min(-across.low, across.high) > kSliver * far) return edge.level;
  return edge.level + (across.high > -across.low ? far : -far) / kStrip;
}

void NearEdges::grade(const Cell& cell, std::vector<Cell>& parts) const {
  if (cell.size() < 3) return;
  for (const Edge& edge : edges_) {
    const auto level = cut_level(edge, cell);
    if (!level) continue;
    const bool room = cell.size() < Cell::kMostCorners;
    const Vec2 across = room ? edge.normal : cell.longest();
    const Cell::Halves halves = cell.cut(across, room ? *level : across.dot(cell.centre()));
    if (std::min(halves.above.area(), halves.below.area()) <= kSliver * cell.area()) continue;
    grade(halves.above, parts);
    grade(halves.below, parts);
    return;
  }
  parts.push_back(cell);
}

std::vector<Cell> NearEdges::graded(std::vector<Cell> cells) const {
  if (edges_.empty()) return cells;
  std::vector<Cell> parts;
  for (const Cell& cell : cells) grade(cell, parts);
  return parts;
}

}  // namespace etendue
