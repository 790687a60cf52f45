// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/factor_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "etendue/form_factor/product_rule.hpp"
#include "etendue/form_factor/sharp_plane.hpp"

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLeastNodes = 2;
constexpr int kMostNodes = 9;
/// Kernel evaluations beyond which form_factor() is the cheaper one.
constexpr double kMostKernels = 6561;

constexpr std::size_t kRules = kMostNodes - kLeastNodes + 1;
using ByRule = std::array<double, kRules>;

/// c_n = 2^(2n+1) (n!)^4 / ((2n+1) ((2n)!)²): the n-point rule errs by c_n times the Taylor coefficient of order 2n at
/// some point of (−1, 1). With it the factors in the bounds of that coefficient for r^(−4) (NOTES.md §8).
struct RuleErrors {
  ByRule remainder{};
  ByRule steep_even{}, steep_odd{};  ///< (k+1)(k+2)(k+3)/6 for k = 2n and 2n − 1
  ByRule flat_even{}, flat_odd{};    ///< (k+2)/2
};

RuleErrors compute_rule_errors() {
  RuleErrors errors;
  double c = 2.0 / 3;  // n = 1: 2^3 / (3 · 2²)
  for (int n = 2; n <= kMostNodes; ++n) {
    const double m = n, k = 2 * n;
    c *= 4 * m * m * m * m * (2 * m - 1) / ((2 * m + 1) * (2 * m) * (2 * m) * (2 * m - 1) * (2 * m - 1));
    const auto i = static_cast<std::size_t>(n - kLeastNodes);
    errors.remainder[i] = c;
    errors.steep_even[i] = (k + 1) * (k + 2) * (k + 3) / 6;
    errors.steep_odd[i] = k * (k + 1) * (k + 2) / 6;
    errors.flat_even[i] = (k + 2) / 2;
    errors.flat_odd[i] = (k + 1) / 2;
  }
  return errors;
}

/// One direction: the lengths and heights that its error follows from.
struct Direction {
  double weight, q, fourth, flat, top, slope;
};

/// The first rule whose error is at most `share`; kRules where there is none.
struct Choice {
  std::size_t rule;
  double error;
};

Choice choose(const Direction& d, const RuleErrors& rules, double share) {
  const double square = d.q * d.q, top = d.top * d.q;
  double power = d.weight * d.q * square;
  for (std::size_t i = 0; i < kRules; ++i) {
    const double even = std::min(rules.steep_even[i] * d.fourth, rules.flat_even[i] * d.flat);
    const double odd = std::min(rules.steep_odd[i] * d.fourth, rules.flat_odd[i] * d.flat);
    const double error = power * rules.remainder[i] * (top * even + d.slope * odd);
    if (error <= share) return {i, error};
    power *= square;
  }
  return {kRules, 0};
}

/// How a pair is served.
struct Plan {
  enum class Kind { nothing, rule, other } kind = Kind::other;
  std::uint32_t key = 0;  ///< nodes in the four directions, three bits each, less kLeastNodes
  double bound = 0;
};

Parallelogram parallelogram(const Polygon& polygon, std::uint32_t plane) {
  const auto& v = polygon.vertices();
  Parallelogram patch{};
  patch.corner = v[0];
  patch.normal = polygon.normal();
  patch.area = polygon.area();
  patch.plane = plane;
  if (v.size() != 4) return patch;
  const Vec3 first = 0.5 * (v[1] - v[0]), second = 0.5 * (v[3] - v[0]);
  patch.half[0] = first;
  patch.half[1] = second;
  patch.centre = first + second;
  patch.length[0] = first.norm();
  patch.length[1] = second.norm();
  patch.radius = std::max((first + second).norm(), (first - second).norm());
  // What the fourth corner misses moves the outline, and the plane; differences and the normal err by a few roundings.
  constexpr double kDifferences = 8;
  const double off = (v[2] - v[1] - 2 * second).norm() + kDifferences * kUnitRoundoff * patch.radius;
  patch.flatness = off;
  patch.shape = 4 * off * (patch.length[0] + patch.length[1]) / patch.area +
                kDifferences * kUnitRoundoff * patch.length[0] * patch.length[1] / patch.area;
  constexpr double kRounded = 0x1p-40;  // more than rounding: no parallelogram
  patch.valid = off <= kRounded * std::min(patch.length[0], patch.length[1]);
  return patch;
}

/// Numbers of planes: the same for all that lie exactly in one and turn the same way.
std::vector<std::uint32_t> planes_of(const std::vector<Polygon>& polygons) {
  struct Group {
    SharpPlane plane;
    double scale;
    std::uint32_t number;
  };
  std::map<std::array<long, 3>, std::vector<Group>> groups;
  std::uint32_t count = 0;
  std::vector<std::uint32_t> planes;
  for (const Polygon& polygon : polygons) {
    const auto& v = polygon.vertices();
    double size = 0;
    for (const Vec3& p : v) size = std::max(size, p.cwiseAbs().maxCoeff());
    const double scale = size > 0 ? std::ldexp(1.0, -std::ilogb(size)) : 1;
    SharpPlane own(localised(v, Vec3::Zero(), scale));
    // Candidates by a rounded normal: a near miss costs time, no more.
    constexpr double kDirections = 1 << 16;
    const Vec3& n = polygon.normal();
    auto& candidates =
        groups[{std::lround(kDirections * n.x()), std::lround(kDirections * n.y()), std::lround(kDirections * n.z())}];
    const auto in_plane = [&](const Group& group) {
      return std::all_of(v.begin(), v.end(), [&](const Vec3& p) { return group.plane.height(group.scale * p) == 0; });
    };
    constexpr std::size_t kMostCandidates = 64;
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(std::min(candidates.size(), kMostCandidates));
    const auto found = own.flatness() == 0 ? std::find_if(candidates.begin(), end, in_plane) : end;
    planes.push_back(found != end ? found->number : count);
    if (found == end) candidates.push_back({std::move(own), scale, count++});
  }
  return planes;
}

Plan plan_of(const Parallelogram& from, const Parallelogram& to, const Tolerance& tolerance) {
  Plan result;
  if (from.plane == to.plane) {
    result.kind = Plan::Kind::nothing;
    return result;
  }
  if (!from.valid || !to.valid) return result;
  const Vec3 between = (to.corner - from.corner) + (to.centre - from.centre);
  const double square = between.squaredNorm(), distance = std::sqrt(square), radii = from.radius + to.radius;
  constexpr double kSmallest = 0x1p-150, kLargest = 0x1p150;  // fourth powers of distances, squares of areas
  if (!(distance > kSmallest && distance < kLargest)) return result;
  const double reach = distance + radii, nearest = distance - radii;
  constexpr double kHeightRoundings = 16;
  const double slack = kHeightRoundings * kUnitRoundoff * reach + from.flatness + to.flatness;
  const double rise[2] = {from.normal.dot(to.half[0]), from.normal.dot(to.half[1])};
  const double fall[2] = {to.normal.dot(from.half[0]), to.normal.dot(from.half[1])};
  const double height = from.normal.dot(between), depth = -to.normal.dot(between);
  const double height_range = std::abs(rise[0]) + std::abs(rise[1]),
               depth_range = std::abs(fall[0]) + std::abs(fall[1]);
  const double highest = height + height_range, deepest = depth + depth_range;
  if (highest < -slack || deepest < -slack) {
    result.kind = Plan::Kind::nothing;
    return result;
  }
  if (!(height - height_range >= -slack && depth - depth_range >= -slack && nearest > 0) || !(highest > 2 * slack) ||
      !(deepest > 2 * slack)) {
    return result;
  }
  const double scale = to.area / kPi, inverse = 1 / nearest, fourth = inverse * inverse * inverse * inverse;
  const double asked = std::max(tolerance.absolute, tolerance.relative * scale * height * depth / (square * square));
  // Rounding: heights err by the slack, r^4 by a few roundings of reach/nearest, the sum by its terms; NOTES.md §8.
  constexpr double kTerms = 2 * kMostNodes + 40, kFourthPower = 32;
  const double rounding =
      scale * fourth *
      (highest * deepest * (kUnitRoundoff * (kTerms + kFourthPower * reach * inverse) + from.shape + to.shape) +
       2 * slack * (highest + deepest));
  const double share = 0.25 * (0.75 * asked - rounding);
  if (!(share > 0)) return result;
  static const RuleErrors rules = compute_rule_errors();
  double kernels = 1;
  double truncation = 0;
  for (int direction = 0; direction < 4; ++direction) {
    const bool own = direction < 2;
    const Parallelogram& patch = own ? from : to;
    const int side = direction % 2;
    const double length = patch.length[side];
    // Off the line along this direction: no point of the pair is nearer to it than `off`.
    const double along = between.dot(patch.half[side]) / length;
    const double off = std::sqrt(std::max(0.0, (1 - 0x1p-48) * square - along * along)) - radii - slack;
    const double flat = off > 0 ? inverse / (off * off * off) : std::numeric_limits<double>::infinity();
    const double q = length * inverse, slope = std::abs(own ? fall[side] : rise[side]);
    const double top = own ? deepest : highest, other = (own ? highest : deepest) + slack;
    // scale/16 for the Jacobians and 8 for the other three rules
    const double weight = 0.5 * scale * other;
    const Choice chosen = choose({weight, q, fourth, flat, top + slack, slope}, rules, share);
    if (chosen.rule == kRules) return result;
    kernels *= static_cast<double>(chosen.rule) + kLeastNodes;
    result.key |= static_cast<std::uint32_t>(chosen.rule) << (3 * direction);
    truncation += chosen.error;
  }
  if (kernels > kMostKernels) return result;
  result.kind = Plan::Kind::rule;
  constexpr double kOwn = 1 + 0x1p-40;  // the roundings of this bound itself
  result.bound = kOwn * (truncation + rounding);
  return result;
}

}  // namespace

FactorRows::FactorRows(std::vector<Polygon> polygons, Instructions instructions)
    : polygons_(std::move(polygons)), wide_(instructions == Instructions::widest && has_wide_vectors()) {
  const std::vector<std::uint32_t> planes = planes_of(polygons_);
  patches_.reserve(polygons_.size());
  for (std::size_t i = 0; i < polygons_.size(); ++i) patches_.push_back(parallelogram(polygons_[i], planes[i]));
}

void FactorRows::row(std::size_t from, std::span<const std::uint32_t> columns, Tolerance tolerance,
                     std::span<Bounded> factors) const {
  require(tolerance.relative >= 0 && tolerance.absolute >= 0, "FactorRows: tolerances are not negative");
  require(from < size() && factors.size() == columns.size(), "FactorRows: indices and spans fit");
  constexpr std::size_t kKeys = 1u << 12;
  const Parallelogram& source = patches_[from];
  std::array<std::uint32_t, kKeys + 1> first{};
  std::vector<std::uint32_t> keys(columns.size(), kKeys), sorted(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    require(columns[k] < size(), "FactorRows: columns are within the set");
    const Plan chosen = plan_of(source, patches_[columns[k]], tolerance);
    factors[k] = {0, chosen.bound};
    if (chosen.kind == Plan::Kind::other) factors[k] = form_factor(polygons_[from], polygons_[columns[k]], tolerance);
    if (chosen.kind != Plan::Kind::rule) continue;
    keys[k] = chosen.key;
    ++first[chosen.key + 1];
  }
  for (std::size_t key = 0; key < kKeys; ++key) first[key + 1] += first[key];
  std::array<std::uint32_t, kKeys> next;
  std::copy(first.begin(), first.end() - 1, next.begin());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (keys[k] < kKeys) sorted[next[keys[k]]++] = static_cast<std::uint32_t>(k);
  }
  ProductRule rule;
  for (std::size_t key = 0; key < kKeys; ++key) {
    if (first[key] == first[key + 1]) continue;
    const auto nodes = [&](int direction) { return kLeastNodes + static_cast<int>(key >> (3 * direction) & 7); };
    rule.set_source(source.half[0], source.half[1], nodes(0), nodes(1));
    for (std::size_t start = first[key]; start < first[key + 1]; start += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t k = sorted[std::min<std::size_t>(start + lane, first[key + 1] - 1)];
        const Parallelogram& to = patches_[columns[k]];
        rule.set_lane(lane, source.normal, (to.corner - source.corner) + (to.centre - source.centre), to.half[0],
                      to.half[1], to.normal);
      }
      rule.sum(nodes(2), nodes(3), wide_);
      for (std::size_t lane = 0; lane < kLanes && start + lane < first[key + 1]; ++lane) {
        const std::size_t k = sorted[start + lane];
        const double value = rule.total[lane] * (patches_[columns[k]].area / (16 * kPi));
        if (factors[k].bound > std::max(tolerance.absolute, tolerance.relative * value)) {
          factors[k] = form_factor(polygons_[from], polygons_[columns[k]], tolerance);  // guessed too large
        } else {
          factors[k].value = std::clamp(value, 0.0, 1.0);
        }
      }
    }
  }
}

std::optional<Bounded> product_factor(const Polygon& from, const Polygon& to, Tolerance tolerance) {
  const Parallelogram source = parallelogram(from, 0), target = parallelogram(to, 1);
  const Plan chosen = plan_of(source, target, tolerance);
  if (chosen.kind == Plan::Kind::nothing) return Bounded{0, 0};
  if (chosen.kind == Plan::Kind::other) return std::nullopt;
  const auto nodes = [&](int direction) { return kLeastNodes + static_cast<int>(chosen.key >> (3 * direction) & 7); };
  ProductRule rule;
  rule.set_source(source.half[0], source.half[1], nodes(0), nodes(1));
  const Vec3 between = (target.corner - source.corner) + (target.centre - source.centre);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    rule.set_lane(lane, source.normal, between, target.half[0], target.half[1], target.normal);
  }
  rule.sum(nodes(2), nodes(3), has_wide_vectors());
  const double value = rule.total[0] * (target.area / (16 * kPi));
  if (chosen.bound > std::max(tolerance.absolute, tolerance.relative * value)) return std::nullopt;
  return Bounded{std::clamp(value, 0.0, 1.0), chosen.bound};
}

}  // namespace etendue
