// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/pair_factor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"

namespace etendue {

namespace {

// One quadrilateral a corner: the corner, the middles of its two edges, and the mean of all corners. A convex polygon's
// parts are convex and cover it; a part too narrow to be a polygon (Polygon::make) leaves the polygon whole.
std::vector<Polygon> quartered(const Polygon& polygon) {
  const auto& v = polygon.vertices();
  const std::size_t n = v.size();
  Vec3 middle = Vec3::Zero();
  for (const Vec3& vertex : v) middle += vertex / static_cast<double>(n);
  std::vector<Polygon> parts;
  for (std::size_t k = 0; k < n; ++k) {
    auto part = Polygon::make({(v[(k + n - 1) % n] + v[k]) / 2, v[k], (v[k] + v[(k + 1) % n]) / 2, middle});
    if (!part) return {polygon};
    parts.push_back(std::move(part).value());
  }
  return parts;
}

std::vector<Polygon> quartered(const std::vector<Polygon>& polygons) {
  std::vector<Polygon> parts;
  for (const Polygon& polygon : polygons) {
    for (Polygon& part : quartered(polygon)) parts.push_back(std::move(part));
  }
  return parts;
}

// One side of a pair.
struct Side {
  Bounded factor, free;
  bool curved = false;
  bool clamped = false;
};

Side seen_from(const Polygon& from, const Polygon& to, const std::vector<const Blocker*>& blockers,
               const AssemblyTolerance& tolerance, const std::optional<Bounded>& free = {}) {
  if (blockers.empty()) {
    const Bounded whole = form_factor(from, to, tolerance.free);
    return {whole, whole, false, false};
  }
  const ObstructedFormFactor found = free ? obstructed_form_factor(from, to, blockers, tolerance.obstructed, *free)
                                          : obstructed_form_factor(from, to, blockers, tolerance.obstructed);
  return {found, found.free, found.curved, found.clamp != Clamp::none};
}

// The mean over the parts of the source, weighted by area.
Side mean_factor(const std::vector<Polygon>& from, const Polygon& to, const std::vector<const Blocker*>& blockers,
                 const AssemblyTolerance& tolerance) {
  double area = 0;
  Bounded sum;
  bool clamped = false;
  for (const Polygon& part : from) {
    const Side side = seen_from(part, to, blockers, tolerance);
    const Bounded& one = side.factor;
    clamped = clamped || side.clamped;
    area += part.area();
    sum.value += part.area() * one.value;
    sum.bound += part.area() * one.bound;
  }
  // Areas, products, sums and the division: no more than four roundings a part.
  const double rounding = gamma_bound(4 * static_cast<int>(from.size())) * sum.value;
  return {{sum.value / area, (sum.bound + rounding) / area}, {}, false, clamped};
}

struct Comparison {
  PairFactor pair;
  bool settled = true;  // nothing to be gained from parts
};

Comparison compared(const Bounded& there, const Bounded& back, double ratio, const Tolerance& tolerance) {
  const PairFactor result = compared_factor(there, back, ratio);
  const double larger = result.factor.value, difference = std::abs(there.value - back.value / ratio);
  // A side that has run out of evaluations (obstructed.cpp) says so by its bound; each part would cost as much again.
  const bool reached = std::max(there.bound, back.bound / ratio) <= allowed_error(tolerance, larger, ratio);
  return {result, !reached || (result.agree && difference <= allowed_error(tolerance, larger, ratio))};
}

// The same from the other side, and from parts until the two agree.
PairFactor checked(const ElementPair& pair, const Side& there, const AssemblyTolerance& tolerance) {
  const double ratio = pair.first.area() / pair.second.area();
  const Side back = seen_from(pair.second, pair.first, pair.blockers, tolerance);
  Comparison result = compared(there.factor, back.factor, ratio, tolerance.obstructed);
  result.pair.free = there.free;
  result.pair.clamped = there.clamped || back.clamped;
  if (pair.blockers.empty()) return result.pair;
  // Of parts half the error is asked: their sum may err by the relative and by the absolute share.
  AssemblyTolerance of_parts = tolerance;
  of_parts.obstructed = {tolerance.obstructed.relative / 2, tolerance.obstructed.absolute / 2};
  std::vector<Polygon> first{pair.first}, second{pair.second};
  for (int k = 1; k <= kMostQuarterings && !result.settled; ++k) {
    first = quartered(first);
    second = quartered(second);
    const Side parts_there = mean_factor(first, pair.second, pair.blockers, of_parts);
    const Side parts_back = mean_factor(second, pair.first, pair.blockers, of_parts);
    result = compared(parts_there.factor, parts_back.factor, ratio, tolerance.obstructed);
    result.pair.clamped = parts_there.clamped || parts_back.clamped;
    result.pair.quarterings = k;
    result.pair.free = there.free;
  }
  return result.pair;
}

}  // namespace

PairFactor compared_factor(const Bounded& there, const Bounded& back, double area_ratio) {
  const Bounded as_there{back.value / area_ratio, back.bound / area_ratio};
  const double difference = std::abs(there.value - as_there.value), larger = std::max(there.value, as_there.value);
  PairFactor result;
  result.checked = true;
  result.factor = {larger, std::max({there.bound, as_there.bound, difference})};
  // Two roundings on A_2 F_21 / A_1.
  result.agree = difference <= there.bound + as_there.bound + gamma_bound(4) * larger;
  result.difference = difference * std::min(1.0, area_ratio);
  return result;
}

PairFactor one_sided_factor(const ElementPair& pair, const AssemblyTolerance& tolerance) {
  const Side there = seen_from(pair.first, pair.second, pair.blockers, tolerance, pair.free);
  if (there.curved) return checked(pair, there, tolerance);
  PairFactor result;
  result.factor = there.factor;
  result.free = there.free;
  result.clamped = there.clamped;
  return result;
}

PairFactor two_sided_factor(const ElementPair& pair, const AssemblyTolerance& tolerance) {
  return checked(pair, seen_from(pair.first, pair.second, pair.blockers, tolerance, pair.free), tolerance);
}

double allowed_error(const Tolerance& tolerance, double factor, double area_ratio) {
  return std::max(tolerance.relative * factor, tolerance.absolute * std::max(1.0, 1 / area_ratio));
}

}  // namespace etendue
