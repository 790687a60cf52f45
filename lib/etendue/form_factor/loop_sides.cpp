// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/loop_sides.hpp"

#include <algorithm>
#include <limits>

namespace etendue {

LoopSides::LoopSides(std::span<const Vec3> receiver, const SightZone& zone) : zone_(zone) {
  loops_.reserve(zone.outlines.size() + 1);
  loops_.push_back(receiver);
  for (const Outline& outline : zone.outlines) loops_.push_back(outline);
  first_.reserve(loops_.size());
  std::size_t edges = 0;
  for (const std::span<const Vec3>& loop : loops_) {
    first_.push_back(edges);
    edges += loop.size();
  }
  rows_.assign(edges * loops_.size(), 0);
  sides_.reserve(edges * edges / 2);
  signs_.reserve(edges * edges / 2);
  apart_.assign(loops_.size() * loops_.size(), -1);
  Vec2 centre = Vec2::Zero();
  for (const Vec2& v : zone.corners) centre += v / static_cast<double>(zone.corners.size());
  for (std::size_t i = 0; i < receiver.size() && receiver_is_convex_; ++i) {
    const std::size_t j = after(0, i);
    // As seen from the source the receiver runs clockwise.
    receiver_is_convex_ = view_side(receiver[i], receiver[j], receiver[after(0, j)]).at(centre) <= 0;
  }
}

void LoopSides::add_row(const Edge& edge, std::size_t loop) {
  const Vec3 &a = start(edge), along = end(edge) - a;
  for (const Vec3& point : loops_[loop]) {
    const Vec3 normal = along.cross(point - a);
    const ViewSide side{-normal.head<2>(), normal.dot(point)};
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Vec2& x : zone_.corners) {
      const double height = side.at(x);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    sides_.push_back(side);
    signs_.push_back(static_cast<signed char>((lowest >= 0) - (highest <= 0)));
  }
}

bool LoopSides::outside(std::size_t loop, std::size_t outline) {
  for (std::size_t j = 0; j < loops_[outline].size(); ++j) {
    bool all = true;
    for (std::size_t c = 0; c < loops_[loop].size() && all; ++c) all = sign({outline, j}, loop, c) < 0;
    if (all) return true;
  }
  return false;
}

bool LoopSides::apart(std::size_t one, std::size_t other) {
  signed char& known = apart_[std::max(one, other) * loops_.size() + std::min(one, other)];
  if (known < 0) known = (other > 0 && outside(one, other)) || (one > 0 && outside(other, one)) ? 1 : 0;
  return known != 0;
}

bool LoopSides::beside(const Edge& edge, const Edge& other) {
  const int start = sign(other, edge.loop, edge.index);
  return start != 0 && start == sign(other, edge.loop, after(edge.loop, edge.index));
}

std::uint64_t LoopSides::beyond_receiver(const Edge& edge) {
  constexpr std::size_t kBits = 64;
  std::uint64_t found = 0;
  if (!receiver_is_convex_) return found;
  for (std::size_t j = 0; j < std::min(kBits, loops_[0].size()); ++j) {
    const bool beyond =
        sign({0, j}, edge.loop, edge.index) > 0 && sign({0, j}, edge.loop, after(edge.loop, edge.index)) > 0;
    if (beyond) found |= std::uint64_t{1} << j;
  }
  return found;
}

}  // namespace etendue
