// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/facing_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace etendue {

namespace {

double extent(const std::vector<Vec3>& vertices) {
  double largest = 0;
  for (const Vec3& v : vertices) largest = std::max(largest, (v - vertices.front()).cwiseAbs().maxCoeff());
  return largest;
}

double perimeter(const std::vector<Vec3>& v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += (v[(i + 1) % v.size()] - v[i]).norm();
  return sum;
}

struct Cut {
  std::vector<Vec3> vertices;
  bool clipped = false;
};

Cut cut_behind(const Loop& loop, const Loop& plane, const Vec3& offset) {
  std::vector<double> heights;
  heights.reserve(loop.vertices.size());
  bool in_front = false, behind = false;
  for (const Vec3& v : loop.vertices) {
    const Vec3 point = offset + v;
    const double height = height_above(plane, point);
    const double error = height_error(plane, point);
    heights.push_back(std::abs(height) <= error ? 0 : height);
    in_front = in_front || height > error;
    behind = behind || height < -error;
  }
  if (!in_front) return {};
  if (!behind) return {loop.vertices, false};
  return {clip(loop.vertices, heights), true};
}

/// Replaces the loop's vertices, keeps its plane. A boundary that moves by d sweeps at most d · perimeter of area, and
/// a piece of area hands over at most itself.
double replace(Loop& loop, Cut cut, double displacement) {
  if (cut.vertices.empty()) {
    loop.vertices.clear();
    return 0;
  }
  if (!cut.clipped) return 0;
  const double moved = displacement * perimeter(cut.vertices);
  Loop remains = make_loop(std::move(cut.vertices));
  remains.normal = loop.normal;
  remains.flatness = loop.flatness;
  loop = std::move(remains);
  return moved;
}

}  // namespace

std::vector<Vec3> localised(const std::vector<Vec3>& vertices, const Vec3& origin, double scale) {
  std::vector<Vec3> result;
  result.reserve(vertices.size());
  for (const Vec3& v : vertices) result.push_back(scale * (v - origin));
  return result;
}

FacingPair facing_pair(const Polygon& from, const Polygon& to) {
  const Vec3& a = from.vertices().front();
  const Vec3& b = to.vertices().front();
  const double size = std::max({extent(from.vertices()), extent(to.vertices()), (b - a).cwiseAbs().maxCoeff()});
  FacingPair pair;
  pair.scale = std::ldexp(1.0, -std::ilogb(size));
  pair.from = make_loop(localised(from.vertices(), a, pair.scale));
  pair.to = make_loop(localised(to.vertices(), b, pair.scale));
  pair.offset = pair.scale * (b - a);
  pair.from_area = pair.from.area;
  Cut to_remains = cut_behind(pair.to, pair.from, pair.offset);
  Cut from_remains = cut_behind(pair.from, pair.to, -pair.offset);
  const double displacement = pair.from.flatness + pair.to.flatness;
  pair.moved = replace(pair.to, std::move(to_remains), displacement);
  pair.moved += replace(pair.from, std::move(from_remains), displacement);
  return pair;
}

}  // namespace etendue
