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

Vec3 mean(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

double radius(std::span<const Vec3> points) {
  const Vec3 centre = mean(points);
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, (p - centre).norm());
  return largest;
}

double least_distance(const Loop& first, const Loop& second, const Vec3& offset) {
  const Vec3 between = offset + (mean(second.vertices) - mean(first.vertices));
  const double balls = between.norm() - radius(first.vertices) - radius(second.vertices);
  const auto above = [](const Loop& plane, const Loop& loop, const Vec3& shift) {
    double least = 0;
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      const Vec3 point = shift + loop.vertices[i];
      const double height = std::abs(height_above(plane, point)) - height_error(plane, point);
      least = i == 0 ? height : std::min(least, height);
    }
    return least;
  };
  return std::max({0.0, balls, above(first, second, offset), above(second, first, -offset)});
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
