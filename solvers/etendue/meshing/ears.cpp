// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/ears.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "etendue/geometry/predicates.hpp"

namespace etendue {

namespace {

using Points = std::vector<Vec2>;
using Chain = std::vector<std::uint32_t>;

/// Is `p` within the triangle or on its edge, and none of its corners (of which bridges leave copies)?
bool is_in(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  return p != a && p != b && p != c && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
         orientation(c, a, p) >= 0;
}

/// Cuts off a corner that turns left and whose triangle has no other corner in it: there is one in every simple polygon.
/// Where flattening has rounded corners onto one line, any corner will do: its triangle has no area.
std::array<std::uint32_t, 3> cut_ear(const Points& points, Chain& rest) {
  const std::size_t n = rest.size();
  std::size_t ear = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 &a = points[rest[(k + n - 1) % n]], &b = points[rest[k]], &c = points[rest[(k + 1) % n]];
    if (orientation(a, b, c) <= 0) continue;
    if (std::any_of(rest.begin(), rest.end(), [&](std::uint32_t p) { return is_in(a, b, c, points[p]); })) continue;
    ear = k;
    break;
  }
  const std::array<std::uint32_t, 3> triangle{rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]};
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  return triangle;
}

/// Does the chain turn right around what it encloses? Its lowest corner, the leftmost of these, is a convex one.
bool turns_right(const Points& points, const Chain& chain) {
  const std::size_t n = chain.size();
  std::size_t low = 0;
  for (std::size_t k = 1; k < n; ++k) {
    const Vec2 &p = points[chain[k]], &q = points[chain[low]];
    if (std::pair(p.y(), p.x()) < std::pair(q.y(), q.x())) low = k;
  }
  return orientation(points[chain[(low + n - 1) % n]], points[chain[low]], points[chain[(low + 1) % n]]) < 0;
}

/// Does the way from corner k of the chain to `p` begin on the chain's left?
bool begins_inside(const Points& points, const Chain& chain, std::size_t k, const Vec2& p) {
  const std::size_t n = chain.size();
  const Vec2 &before = points[chain[(k + n - 1) % n]], &at = points[chain[k]], &after = points[chain[(k + 1) % n]];
  const bool left_of_first = orientation(before, at, p) > 0, left_of_second = orientation(at, after, p) > 0;
  return orientation(before, at, after) > 0 ? left_of_first && left_of_second : left_of_first || left_of_second;
}

/// Does the segment meet an edge of the chain, other than at the segment's own ends?
bool meets(const Points& points, const Chain& chain, const Vec2& from, const Vec2& to) {
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Vec2 &a = points[chain[k]], &b = points[chain[(k + 1) % chain.size()]];
    if (a == from || a == to || b == from || b == to) continue;
    if (segments_meet(from, to, a, b)) return true;
  }
  return false;
}

/// Makes `around` and the first of `holes` one chain, joined where `around` sees the hole's rightmost corner.
void bridge(const Points& points, Chain& around, const std::vector<Chain>& holes) {
  const Chain& hole = holes.front();  // begins with its rightmost corner
  const Vec2& from = points[hole.front()];
  std::size_t best = around.size();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < around.size(); ++k) {
    const Vec2& to = points[around[k]];
    const double distance = (to - from).squaredNorm();
    if (!(distance < nearest) || !begins_inside(points, around, k, from) || meets(points, around, from, to)) continue;
    if (std::any_of(holes.begin(), holes.end(), [&](const Chain& other) { return meets(points, other, from, to); }))
      continue;
    best = k;
    nearest = distance;
  }
  if (best == around.size()) return;  // only where rounding has made chains touch: the hole stays filled
  Chain joined(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(best) + 1);
  joined.insert(joined.end(), hole.begin(), hole.end());
  joined.push_back(hole.front());
  joined.insert(joined.end(), around.begin() + static_cast<std::ptrdiff_t>(best), around.end());
  around = std::move(joined);
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> ears(const Points& points, Chain outline, std::vector<Chain> holes) {
  const auto is_left_of = [&](std::uint32_t a, std::uint32_t b) { return points[a].x() < points[b].x(); };
  for (Chain& hole : holes) {
    if (!turns_right(points, hole)) std::reverse(hole.begin(), hole.end());
    std::rotate(hole.begin(), std::max_element(hole.begin(), hole.end(), is_left_of), hole.end());
  }
  // From the right: what is right of a hole's rightmost corner is then one chain already, and some corner of it is seen.
  std::sort(holes.begin(), holes.end(),
            [&](const Chain& a, const Chain& b) { return is_left_of(b.front(), a.front()); });
  while (!holes.empty()) {
    bridge(points, outline, holes);
    holes.erase(holes.begin());
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (outline.size() > 3) triangles.push_back(cut_ear(points, outline));
  triangles.push_back({outline[0], outline[1], outline[2]});
  return triangles;
}

}  // namespace etendue
