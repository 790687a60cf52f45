// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/facing_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/sharp_plane.hpp"

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

/// Up to this share of size and distance, the rounding of coordinates, a vertex counts as on the other's plane where
/// the two turn the same way: patches of one wall do not see one another by their rounding.
constexpr double kTouching = 16 * kUnitRoundoff;
/// Error of the sine and the cosine of two unit normals in double.
constexpr double kAngleError = 16 * kUnitRoundoff;

/// One polygon of the pair: scaled where it stands, for the decisions, and around its first vertex, for the integrals.
struct Placed {
  std::vector<Vec3> vertices;
  SharpPlane plane;
  Loop loop;
};

Placed placed(const Polygon& polygon, double scale) {
  std::vector<Vec3> vertices = localised(polygon.vertices(), Vec3::Zero(), scale);
  SharpPlane plane(vertices);
  Loop loop = make_loop(localised(polygon.vertices(), polygon.vertices().front(), scale));
  return {std::move(vertices), std::move(plane), std::move(loop)};
}

/// True where `b` is `a` run the other way round, vertex for vertex: the two sides of one surface.
bool is_reverse(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const std::size_t n = a.size();
  for (std::size_t start = 0; start < n && b.size() == n; ++start) {
    std::size_t i = 0;
    while (i < n && a[i] == b[(start + n - i) % n]) ++i;
    if (i == n) return true;
  }
  return false;
}

struct Cut {
  std::vector<Vec3> vertices;
  bool clipped = false;
  double moved = 0;
};

/// What of `cut` lies in front of the plane of `by`; `moved` is derived in NOTES.md §7.
Cut cut_behind(const Placed& cut, const Placed& by, double sine) {
  const double cosine = cut.loop.normal.dot(by.loop.normal);
  const double unflat = cut.plane.flatness() + by.plane.flatness();
  std::vector<double> heights;
  double off = 0, sharp = 0, lowest = 0, highest = 0;
  for (const Vec3& v : cut.vertices) {
    double height = by.plane.height(v);
    lowest = heights.empty() ? height : std::min(lowest, height);
    highest = heights.empty() ? height : std::max(highest, height);
    sharp = std::max(sharp, by.plane.error(v));
    const double touching = by.plane.flatness() + kTouching * (1 + (v - by.vertices.front()).norm());
    if (cosine >= 0 && std::abs(height) <= touching) {
      off = std::max(off, std::abs(height));
      height = 0;
    }
    heights.push_back(height);
  }
  const bool in_front = *std::max_element(heights.begin(), heights.end()) > 0;
  const bool behind = *std::min_element(heights.begin(), heights.end()) < 0;
  const double most = std::min(cut.loop.area, by.loop.area), outline = perimeter(cut.loop.vertices);
  if (!in_front) {
    if (highest + unflat <= 0 || is_reverse(cut.vertices, by.vertices)) return {};
    // (1 − cos)/sin: what every point of a sliver hands over, by its width.
    const double share = cosine >= 0 ? (sine + kAngleError) / (1 + cosine) : 2 / sine;
    return {{}, false, std::min(most, (off + unflat) * share * outline)};
  }
  if (!behind) return {cut.loop.vertices, false, off > 0 && lowest < 0 ? std::min(most, off / sine * outline) : 0};
  constexpr int kCutRoundings = 8;  // the share, its product with the edge, the sum: along the edge only
  const double rounding = kCutRoundings * kUnitRoundoff * outline;
  const double width = (off + unflat + sharp) / sine + rounding;
  return {clip(cut.loop.vertices, heights), true, std::min(most, width * outline)};
}

/// Replaces the loop's vertices, keeps its plane.
void replace(Loop& loop, Cut cut) {
  if (cut.vertices.empty()) {
    loop.vertices.clear();
    return;
  }
  if (!cut.clipped) return;
  Loop remains = make_loop(std::move(cut.vertices));
  remains.normal = loop.normal;
  remains.flatness = loop.flatness;
  loop = std::move(remains);
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
  Placed from_placed = placed(from, pair.scale), to_placed = placed(to, pair.scale);
  const double sine = least_sine(from_placed.plane, to_placed.plane);
  Cut to_remains = cut_behind(to_placed, from_placed, sine);
  Cut from_remains = cut_behind(from_placed, to_placed, sine);
  pair.from = std::move(from_placed.loop);
  pair.to = std::move(to_placed.loop);
  pair.offset = pair.scale * (b - a);
  pair.from_area = pair.from.area;
  pair.moved = to_remains.moved + from_remains.moved;
  if (to_remains.vertices.empty() || from_remains.vertices.empty()) {
    // Either cut alone decides that nothing is seen: the surer one counts.
    pair.moved = std::min(to_remains.vertices.empty() ? to_remains.moved : pair.moved,
                          from_remains.vertices.empty() ? from_remains.moved : pair.moved);
  }
  replace(pair.to, std::move(to_remains));
  replace(pair.from, std::move(from_remains));
  return pair;
}

}  // namespace etendue
