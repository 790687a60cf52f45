// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/facing_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/sharp_plane.hpp"
#include "etendue/form_factor/triple.hpp"
#include "etendue/geometry/extent.hpp"

namespace etendue {

namespace {

double perimeter(const std::vector<Vec3>& v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += (v[(i + 1) % v.size()] - v[i]).norm();
  return sum;
}

/// Up to this share of size and distance, the rounding of coordinates, a vertex counts as on the other's plane where
/// the two turn the same way: patches of one wall do not see one another by their rounding.
constexpr double kTouching = 16 * kUnitRoundoff;
/// A cut is made in twice the digits: a share, its product with the edge, the sum, the difference of two heights.
constexpr double kCutError = 0x1p-90;
constexpr double kPi = std::numbers::pi;
/// Error of the sine and the cosine of two unit normals in double.
constexpr double kAngleError = 16 * kUnitRoundoff;

/// One region of the pair, scaled where it stands.
struct Placed {
  Boundary loops;
  SharpPlane plane;
  double flatness = 0;
  double area = 0;
  double outline = 0;  ///< length of the whole boundary
};

Placed placed(const Boundary& boundary, double scale) {
  Boundary loops;
  for (const auto& loop : boundary) loops.push_back(localised(loop, Vec3::Zero(), scale));
  SharpPlane plane(loops.front());
  Placed region{std::move(loops), std::move(plane), 0, 0, 0};
  region.flatness = region.plane.flatness();
  region.area = region.plane.area();
  for (std::size_t i = 0; i < region.loops.size(); ++i) {
    region.outline += perimeter(region.loops[i]);
    if (i == 0) continue;
    for (const Vec3& v : region.loops[i]) region.flatness = std::max(region.flatness, std::abs(region.plane.height(v)));
    region.area -= SharpPlane(region.loops[i]).area();
  }
  return region;
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

bool is_corner(const Vec3& v, const Boundary& loops) {
  for (const auto& loop : loops) {
    for (const Vec3& corner : loop) {
      if (corner == v) return true;
    }
  }
  return false;
}

/// How the two planes lie to one another, and a lower bound on the regions' distance.
struct Sight {
  double sine, cosine, gap;
};

struct Cut {
  std::vector<Chain> chains;  ///< empty where nothing is in front
  bool clipped = false;
  double moved = 0;
  double behind = 0;
};

DoubleDouble3 exact(const Vec3& v, const Vec3& origin) {
  return exact_difference(v, origin);
}

Chain whole(const std::vector<Vec3>& loop, const Vec3& origin) {
  Chain chain;
  chain.reserve(loop.size());
  for (const Vec3& v : loop) chain.push_back(exact(v, origin));
  return chain;
}

/// What of the loop has a height that is not negative (Sutherland and Hodgman 1974).
Chain clipped(const std::vector<Vec3>& loop, const std::vector<DoubleDouble>& heights, const Vec3& origin) {
  Chain kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t next = (i + 1) % loop.size();
    const DoubleDouble &here = heights[i], &there = heights[next];
    const DoubleDouble3 v = exact(loop[i], origin);
    if (here.high >= 0) kept.push_back(v);
    if ((here.high > 0 && there.high < 0) || (here.high < 0 && there.high > 0)) {
      const DoubleDouble share = here / (here - there);
      const DoubleDouble3 edge = exact(loop[next], loop[i]);
      kept.push_back({v.x + share * edge.x, v.y + share * edge.y, v.z + share * edge.z});
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

/// The heights of a region's vertices over the other's plane.
struct Heights {
  std::vector<std::vector<DoubleDouble>> of;
  double off = 0;    ///< largest of those that count as zero
  double sunk = 0;   ///< largest of them that is below
  double sharp = 0;  ///< what the others err by
  double lowest = 0, highest = 0;
  bool in_front = false, behind = false;
};

Heights heights_of(const Placed& cut, const Placed& by, double cosine, Sides sides) {
  Heights heights;
  bool first = true;
  for (const auto& loop : cut.loops) {
    heights.of.emplace_back();
    for (const Vec3& v : loop) {
      // A corner of the other's outline lies on every surface with that outline.
      DoubleDouble height = 0;
      if (!is_corner(v, by.loops)) height = sides == Sides::exact ? by.plane.exact_height(v) : by.plane.wide_height(v);
      heights.lowest = first ? height.high : std::min(heights.lowest, height.high);
      heights.highest = first ? height.high : std::max(heights.highest, height.high);
      first = false;
      const double error = sides == Sides::exact ? kCutError * std::abs(height.high) : by.plane.error(v);
      heights.sharp = std::max(heights.sharp, error);
      const double touching = by.flatness + kTouching * (1 + (v - by.loops[0].front()).norm());
      if (sides == Sides::rounded && cosine >= 0 && std::abs(height.high) <= touching) {
        heights.off = std::max(heights.off, std::abs(height.high));
        heights.sunk = std::max(heights.sunk, -height.high);
        height = 0;
      }
      heights.in_front = heights.in_front || height.high > 0;
      heights.behind = heights.behind || height.high < 0;
      heights.of.back().push_back(height);
    }
  }
  return heights;
}

/// What of `cut` lies in front of the plane of `by`, around `origin`; `moved` and `behind` are derived in NOTES.md §7.
Cut cut_behind(const Placed& cut, const Placed& by, const Sight& sight, const Vec3& origin, Sides sides) {
  const double cosine = sight.cosine, sine = sight.sine;
  const double unflat = cut.flatness + by.flatness;
  const bool flat = unflat == 0;
  const Heights heights = heights_of(cut, by, cosine, flat ? sides : Sides::rounded);
  const double most = std::min(cut.area, by.area), outline = cut.outline;
  const auto swept = [&](double height, double rounding) {
    return std::min(cut.area, (height / sine + rounding) * outline);
  };
  const auto moved = [&](double height, double rounding) {
    // What the line of the cut sweeps, and what every point of it hands over.
    if (height + rounding == 0) return 0.0;
    const double grazing = sight.gap > 0 ? 2 * (height + rounding) * by.area / (kPi * std::pow(sight.gap, 3)) : 1;
    const double beyond = cosine >= 0 ? 0.5 * (sine + kAngleError) * (sine + kAngleError) / (1 + cosine) : 1;
    return std::min(most, swept(height, rounding) * std::min({1.0, grazing, beyond}));
  };
  if (!heights.in_front) {
    if (heights.highest + unflat <= 0 || is_reverse(cut.loops[0], by.loops[0])) return {};
    return {{}, false, moved(heights.off + unflat, 0), 0};
  }
  const bool behind = heights.behind;
  Cut result;
  result.clipped = behind;
  for (std::size_t i = 0; i < cut.loops.size(); ++i) {
    Chain chain = behind ? clipped(cut.loops[i], heights.of[i], origin) : whole(cut.loops[i], origin);
    if (!chain.empty()) result.chains.push_back(std::move(chain));
  }
  if (behind) {
    result.moved = moved(heights.off + unflat + heights.sharp, kCutError * outline);
  } else if (heights.off > 0 && heights.lowest < 0) {
    result.moved = moved(heights.off, 0);
  }
  // Of a bent polygon what is within its bend is on its plane by definition; a flat one has been left behind the other's.
  // From there the other's back is seen, and it may be near.
  if (flat && heights.sunk > 0) result.behind = std::min(most, swept(heights.sunk, 0) * 0.5 * (1 + cosine));
  return result;
}

/// A lower bound on the distance of the two regions: one of them may lie wholly off the other's plane.
double gap_between(const Placed& a, const Placed& b) {
  const auto off = [](const Placed& plane, const Placed& region) {
    double least = 0;
    for (std::size_t i = 0; i < region.loops[0].size(); ++i) {
      const Vec3& v = region.loops[0][i];
      const double height = plane.plane.height(v) - plane.plane.error(v) - plane.flatness - region.flatness;
      least = i == 0 ? height : std::min(least, height);
    }
    return least * (1 - 4 * kUnitRoundoff);
  };
  return std::max({0.0, off(a, b), off(b, a)});
}

/// The loops of the area rule: around the region's own first vertex, with the whole region's plane.
std::vector<Loop> loops_of(const std::vector<Chain>& chains, const DoubleDouble3& origin, const Placed& whole) {
  std::vector<Loop> loops;
  for (const Chain& chain : chains) {
    std::vector<Vec3> vertices;
    vertices.reserve(chain.size());
    for (const DoubleDouble3& v : chain) {
      vertices.push_back({rounded(v.x - origin.x), rounded(v.y - origin.y), rounded(v.z - origin.z)});
    }
    Loop loop = make_loop(std::move(vertices));
    loop.normal = whole.plane.normal();
    loop.flatness = std::max(loop.flatness, whole.flatness);
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

std::vector<Vec3> localised(const std::vector<Vec3>& vertices, const Vec3& origin, double scale) {
  std::vector<Vec3> result;
  result.reserve(vertices.size());
  for (const Vec3& v : vertices) result.push_back(scale * (v - origin));
  return result;
}

FacingRegions facing_regions(const Boundary& from, const Boundary& to, Sides sides) {
  const Vec3& a = from.front().front();
  const Vec3& b = to.front().front();
  const double size =
      std::max({extent_of(from.front()).size, extent_of(to.front()).size, (b - a).cwiseAbs().maxCoeff()});
  FacingRegions pair;
  pair.scale = std::ldexp(1.0, -std::ilogb(size));
  const Placed from_placed = placed(from, pair.scale), to_placed = placed(to, pair.scale);
  pair.flat = from_placed.flatness == 0 && to_placed.flatness == 0;
  const Sight sight{least_sine(from_placed.plane, to_placed.plane),
                    from_placed.plane.normal().dot(to_placed.plane.normal()), gap_between(from_placed, to_placed)};
  const Vec3 origin = pair.scale * a;
  Cut to_remains = cut_behind(to_placed, from_placed, sight, origin, sides);
  Cut from_remains = cut_behind(from_placed, to_placed, sight, origin, sides);
  pair.from_area = from_placed.area;
  pair.moved = to_remains.moved + from_remains.moved;
  pair.behind = to_remains.behind + from_remains.behind;
  if (to_remains.chains.empty() || from_remains.chains.empty()) {
    // Either cut alone decides that nothing is seen: the surer one counts.
    pair.moved = std::min(to_remains.chains.empty() ? to_remains.moved : pair.moved,
                          from_remains.chains.empty() ? from_remains.moved : pair.moved);
    pair.behind = 0;
  }
  const DoubleDouble3 between = exact_difference(pair.scale * b, origin);
  pair.offset = {rounded(between.x), rounded(between.y), rounded(between.z)};
  pair.from_loops = loops_of(from_remains.chains, {}, from_placed);
  pair.to_loops = loops_of(to_remains.chains, between, to_placed);
  pair.from = std::move(from_remains.chains);
  pair.to = std::move(to_remains.chains);
  return pair;
}

FacingPair facing_pair(const Polygon& from, const Polygon& to) {
  FacingRegions regions = facing_regions({from.vertices()}, {to.vertices()});
  FacingPair pair;
  if (!regions.from_loops.empty()) pair.from = std::move(regions.from_loops.front());
  if (!regions.to_loops.empty()) pair.to = std::move(regions.to_loops.front());
  pair.offset = regions.offset;
  pair.from_area = regions.from_area;
  pair.moved = regions.moved;
  pair.scale = regions.scale;
  return pair;
}

}  // namespace etendue
