// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "etendue/core/rounding.hpp"

namespace etendue {

Loop make_loop(std::vector<Vec3> vertices) {
  Loop loop;
  loop.vertices = std::move(vertices);
  const Vec3& base = loop.vertices.front();
  Vec3 doubled = Vec3::Zero();
  double reach = 0;
  for (std::size_t i = 1; i < loop.vertices.size(); ++i) {
    if (i + 1 < loop.vertices.size()) doubled += (loop.vertices[i] - base).cross(loop.vertices[i + 1] - base);
    reach = std::max(reach, (loop.vertices[i] - base).norm());
  }
  const double norm = doubled.norm();
  loop.area = 0.5 * norm;
  if (norm > 0) loop.normal = doubled / norm;
  for (const Vec3& v : loop.vertices) loop.flatness = std::max(loop.flatness, std::abs(height_above(loop, v)));
  loop.flatness += 4 * kUnitRoundoff * reach;
  return loop;
}

double height_error(const Loop& plane, const Vec3& point) {
  constexpr int kRoundings = 8;  // difference, dot product of three, components of a unit normal
  return plane.flatness + gamma_bound(kRoundings) * (point - plane.vertices.front()).norm();
}

std::vector<Vec3> clip(std::span<const Vec3> loop, std::span<const double> heights) {
  std::vector<Vec3> kept;
  kept.reserve(loop.size() + 2);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t next = (i + 1) % loop.size();
    if (heights[i] >= 0) kept.push_back(loop[i]);
    if ((heights[i] > 0 && heights[next] < 0) || (heights[i] < 0 && heights[next] > 0)) {
      const double share = heights[i] / (heights[i] - heights[next]);
      kept.push_back(loop[i] + share * (loop[next] - loop[i]));
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

}  // namespace etendue
