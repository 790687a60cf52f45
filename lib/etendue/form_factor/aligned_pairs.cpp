// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/aligned_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/difference_rule.hpp"
#include "etendue/form_factor/taylor_coefficients.hpp"

// Vectors are handed from one inlined function to another only: no calling convention is concerned.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;
using namespace aligned;
/// Cosines nearer than this to 0 or ±1 count as such; what they are off goes into the bound.
constexpr double kParallel = 0x1p-20;
/// Lengths nearer than this, relatively, count as equal; likewise.
constexpr double kEqual = 0x1p-36;
constexpr double kShortest = 0x1p-100, kLongest = 0x1p100;  ///< fourth powers stay in range

/// The factors in the bound of the Taylor coefficient of order k = 2n, and the two rules' remainders; NOTES.md §8.
struct RuleBounds {
  std::array<double, kRules> difference{}, product{}, steep{}, flat{};
};

RuleBounds compute_rule_bounds() {
  RuleBounds bounds;
  for (int n = kLeastNodes; n <= kMostDifferenceNodes; ++n) {
    const auto i = static_cast<std::size_t>(n - kLeastNodes);
    bounds.difference[i] = difference_remainder(n);
    bounds.product[i] = n <= kMostProductNodes ? 2 * legendre_remainder(n) : HUGE_VAL;
    bounds.steep[i] = steep_coefficient(2 * n);
    bounds.flat[i] = flat_coefficient(2 * n);
  }
  return bounds;
}

const RuleBounds& rule_bounds() {
  static const RuleBounds bounds = compute_rule_bounds();
  return bounds;
}

// Four lanes as one value. Vectors are written out where there are choices to make: loops with conditions are not
// turned into vectors by every compiler.
using Four = double __attribute__((vector_size(32)));
using Mask = long long __attribute__((vector_size(32)));
constexpr std::size_t kHalves = kLanes / 4;

[[gnu::always_inline]] inline Four load(const Lanes& lanes, std::size_t half) {
  Four four;
  std::memcpy(&four, lanes.data() + 4 * half, sizeof four);
  return four;
}
[[gnu::always_inline]] inline void store(Lanes& lanes, std::size_t half, const Four& four) {
  std::memcpy(lanes.data() + 4 * half, &four, sizeof four);
}
[[gnu::always_inline]] inline Four all(double x) {
  return Four{x, x, x, x};
}
[[gnu::always_inline]] inline Four either(const Mask& mask, const Four& yes, const Four& no) {
  return mask ? yes : no;
}
[[gnu::always_inline]] inline Four larger(const Four& a, const Four& b) {
  return either(a > b, a, b);
}
[[gnu::always_inline]] inline Four smaller(const Four& a, const Four& b) {
  return either(a < b, a, b);
}
[[gnu::always_inline]] inline Four absolute(const Four& a) {
  return larger(a, -a);
}
[[gnu::always_inline]] inline bool any(const Mask& mask) {
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}

struct Vector {
  Four x, y, z;
};
[[gnu::always_inline]] inline Vector load(const std::array<Lanes, 3>& lanes, std::size_t half) {
  return {load(lanes[0], half), load(lanes[1], half), load(lanes[2], half)};
}
[[gnu::always_inline]] inline Four dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] inline Vector either(const Mask& mask, const Vector& yes, const Vector& no) {
  return {either(mask, yes.x, no.x), either(mask, yes.y, no.y), either(mask, yes.z, no.z)};
}

/// A pair as its frames have it.
struct Pairs {
  Vector between;
  Four height, depth, reach, delta, flatness;
  Mask perpendicular, opposite;
  Mask source_first, target_first, crossed;
};

/// |cosine|, and how far it is from 0 or 1.
struct Cosine {
  Four size, off;
};
[[gnu::always_inline]] inline Cosine cosine(const Vector& a, const Vector& b) {
  const Four size = absolute(dot(a, b));
  return {size, smaller(size, absolute(1.0 - size))};
}

[[gnu::always_inline]] inline Pairs classified(const PatchLanes& f, const PatchLanes& t, std::size_t half) {
  const Vector a = load(f.first, half), b = load(f.second, half), n = load(f.normal, half);
  const Vector c = load(t.first, half), d = load(t.second, half), m = load(t.normal, half);
  const Vector corner_1 = load(f.corner, half), corner_2 = load(t.corner, half);
  const Vector centre_1 = load(f.centre, half), centre_2 = load(t.centre, half);
  Pairs p;
  p.between = {(corner_2.x - corner_1.x) + (centre_2.x - centre_1.x),
               (corner_2.y - corner_1.y) + (centre_2.y - centre_1.y),
               (corner_2.z - corner_1.z) + (centre_2.z - centre_1.z)};
  const Cosine ac = cosine(a, c), ad = cosine(a, d), bc = cosine(b, c), bd = cosine(b, d);
  const Cosine nc = cosine(n, c), nd = cosine(n, d), ma = cosine(m, a), mb = cosine(m, b), nm = cosine(n, m);
  const Four off_1 = larger(larger(ac.off, ad.off), larger(bc.off, bd.off));
  const Four off_2 = larger(larger(nc.off, nd.off), larger(ma.off, mb.off));
  const Four off = larger(larger(off_1, off_2), nm.off);
  const Four skew = load(f.skew, half) + load(t.skew, half);
  p.reach = absolute(p.between.x) + absolute(p.between.y) + absolute(p.between.z) + load(f.radius, half) +
            load(t.radius, half);
  const Four tilt = off + 2.0 * skew + 8.0 * kUnitRoundoff;
  const Mask aligned = (tilt < kParallel) & (p.reach < kLongest);
  p.height = dot(n, p.between);
  p.depth = -dot(m, p.between);
  p.delta = (4.0 * tilt + 24.0 * kUnitRoundoff) * p.reach;
  p.flatness = load(f.flatness, half) + load(t.flatness, half);
  p.perpendicular = aligned & (nm.size < 0.5);
  p.opposite = aligned & (dot(n, m) < -0.5);
  p.source_first = ma.size > 0.5;
  p.target_first = nc.size > 0.5;
  p.crossed = ac.size < 0.5;
  return p;
}

/// The integrand's greatest value and what its Taylor coefficients follow from, and what is asked.
struct Bounds {
  Four greatest, inverse_square;
  Four scale, left, rounding;
  Mask usable;
};

/// What is asked of the factor, and what displacements and rounding take of that. `square` is that of the least distance.
[[gnu::always_inline]] inline Bounds bounds_of(const AlignedPlan& plan, const Pairs& p, std::size_t half,
                                               const Four& greatest, const Four& square, const Four& delta,
                                               const Four& highest, const Four& deepest) {
  constexpr double kTerms = 2 * kMostDifferenceNodes + 40, kFourthPower = 64, kDisplaced = 5;
  Bounds b;
  b.greatest = greatest;
  b.inverse_square = 1.0 / square;
  b.scale = load(plan.to.area, half) * (1 / kPi);
  const Four slack = 2.0 * delta + p.flatness, fourth = b.scale * b.inverse_square * b.inverse_square;
  const Four centres = dot(p.between, p.between);
  const Four guess = plan.relative * b.scale * p.height * p.depth / (centres * centres);
  const Four asked = larger(load(plan.absolute, half), guess);
  const Four spread = p.reach * p.reach * b.inverse_square;
  const Four shape = load(plan.from.shape, half) + load(plan.to.shape, half);
  b.rounding =
      b.scale * greatest *
          (kUnitRoundoff * (kTerms + kFourthPower * spread) + kDisplaced * delta * p.reach * b.inverse_square) +
      fourth * (highest * deepest * shape + 2.0 * slack * (highest + deepest));
  b.left = 0.75 * asked - b.rounding;
  constexpr double kSpread = 0x1p20;      // so that the roundings of this bound itself are next to nothing
  constexpr double kClearance = 0x1p-20;  // of delta² in square: what displaces is small beside the distance
  b.usable = (b.left > 0.0) & (delta * delta < kClearance * square) & (spread < kSpread) & (highest > 2.0 * slack) &
             (deepest > 2.0 * slack);
  return b;
}

/// Bounds (r/p)³ = x √x, x = 1 + u²/p², at the nearest u, p the least distance off the line.
[[gnu::always_inline]] inline Four cone(const Four& u, const Four& off_line_square) {
  const Four x = 1.0 + u * u / off_line_square;
  return 0.5 * x * (1.0 + x);
}

/// The first rule whose error is at most a goal, counted from the least.
struct Choice {
  Four rule, error;
  Mask found;
};

/// Nodes along one direction: of the rule for equal lengths, or of both rules for unequal ones.
[[gnu::always_inline]] inline Choice choose_nodes(const Bounds& b, const Four& length_1, const Four& length_2,
                                                  const Four& cones, const Mask& equal, double share) {
  const RuleBounds& rules = rule_bounds();
  const Four ratio_1 = length_1 * length_1 * b.inverse_square, ratio_2 = length_2 * length_2 * b.inverse_square;
  const Four base = 0.25 * b.scale * b.greatest, goal = share * b.left;
  Four power_1 = ratio_1, power_2 = ratio_2;
  Choice choice{all(0), all(0), b.usable ^ b.usable};
  for (std::size_t n = 0; n < kRules; ++n) {
    power_1 *= ratio_1;
    power_2 *= ratio_2;
    const Four coefficient = smaller(all(rules.steep[n]), rules.flat[n] * cones);
    const Four remainder = either(equal, rules.difference[n] * power_1, rules.product[n] * (power_1 + power_2));
    const Four error = base * coefficient * remainder;
    const Mask take = (error <= goal) & ~choice.found;
    choice.rule = either(take, all(static_cast<double>(n)), choice.rule);
    choice.error = either(take, error, choice.error);
    choice.found |= take;
    if (!any(b.usable & ~choice.found)) break;
  }
  return choice;
}

/// Terms of the series atanh z = z (1 + z²/3 + z⁴/5 + …).
[[gnu::always_inline]] inline Choice choose_terms(const Bounds& b, const Four& square, double share) {
  const Four goal = share * b.left;
  Four power = square / (1.0 - square) * b.scale * b.greatest;
  Choice choice{all(0), all(0), b.usable ^ b.usable};
  for (int terms = kLeastTerms; terms <= kMostTerms; ++terms) {
    power *= square;
    const Four error = power * (1.0 / (2 * terms + 1));
    const Mask take = (error <= goal) & ~choice.found;
    choice.rule = either(take, all(static_cast<double>(terms - kLeastTerms)), choice.rule);
    choice.error = either(take, error, choice.error);
    choice.found |= take;
    if (!any(b.usable & ~choice.found)) break;
  }
  return choice;
}

constexpr double kOwn = 1 + 0x1p-16;  // the roundings of the bound itself, kSpread times a few dozen

/// Keys and bounds of the four pairs that both choices serve.
[[gnu::always_inline]] inline Mask decide(AlignedPlan& plan, std::size_t half, const Bounds& b, const Choice& first,
                                          const Choice& second, const Four& kind) {
  const Mask served = b.usable & first.found & second.found;
  const Four key = first.rule + static_cast<double>(kTermsAt) * second.rule + kind;
  const Four bound = kOwn * (first.error + second.error + b.rounding);
  for (std::size_t l = 0; l < 4; ++l) {
    if (served[l] == 0) continue;
    plan.key[4 * half + l] = static_cast<std::uint32_t>(key[l]);
    plan.bound[4 * half + l] = bound[l];
  }
  return served;
}

[[gnu::always_inline]] inline void plan_perpendicular(AlignedPlan& plan, const Pairs& p, std::size_t half) {
  const PatchLanes &f = plan.from, &t = plan.to;
  const Four a = load(f.length_1, half), b = load(f.length_2, half);
  const Four c = load(t.length_1, half), d = load(t.length_2, half);
  const Four across = either(p.source_first, a, b), first = either(p.source_first, b, a);
  const Four up = either(p.target_first, c, d), second = either(p.target_first, d, c);
  const Vector common = either(p.source_first, load(f.second, half), load(f.first, half));
  const Four u = absolute(dot(p.between, common));
  const Four s_1 = p.depth - across, s_2 = p.depth + across, t_1 = p.height - up, t_2 = p.height + up;
  const Four ss_1 = s_1 * s_1, ss_2 = s_2 * s_2, tt_1 = t_1 * t_1, tt_2 = t_2 * t_2;
  const Four product = 16.0 * (p.depth * across) * (p.height * up);
  const Four difference = absolute(first - second);
  const Mask equal = difference <= kEqual * first;
  const Four delta = p.delta + either(equal, difference, all(0));
  const Four near_u = larger(u - first - second, all(0)), near_s = larger(s_1, all(0)), near_t = larger(t_1, all(0));
  const Four off_line = near_s * near_s + near_t * near_t, uu = near_u * near_u;
  const Four ad = (uu + (ss_1 + tt_1)) * (uu + (ss_2 + tt_2)), bc = (uu + (ss_1 + tt_2)) * (uu + (ss_2 + tt_1));
  const Four argument = product / (ad + bc), square = argument * argument;
  const Four greatest = argument * (1.0 + square / (3.0 * (1.0 - square))) / (8.0 * (across * up));
  Bounds bounds = bounds_of(plan, p, half, greatest, uu + off_line, delta, t_2, s_2);
  const Four slack = 2.0 * delta + p.flatness;
  bounds.usable &= p.perpendicular & (s_1 >= -slack) & (t_1 >= -slack) & (square < 0.5);
  const Choice nodes = choose_nodes(bounds, first, second, cone(near_u, off_line), equal, 0.75);
  const Choice terms = choose_terms(bounds, square, 0.25);
  decide(plan, half, bounds, nodes, terms, either(equal, all(kEqualAt), all(0)));
  AlignedLanes& out = plan.lanes;
  store(out.u, half, u);
  store(out.first, half, first);
  store(out.second, half, second);
  store(out.product, half, product);
  store(out.squares[0], half, ss_1 + tt_1);
  store(out.squares[1], half, ss_1 + tt_2);
  store(out.squares[2], half, ss_2 + tt_1);
  store(out.squares[3], half, ss_2 + tt_2);
  store(out.factor, half, second / (8.0 * kPi * across));
}

[[gnu::always_inline]] inline void plan_opposite(AlignedPlan& plan, const Pairs& p, std::size_t half) {
  const PatchLanes &f = plan.from, &t = plan.to;
  const Four first = load(f.length_1, half), second = load(f.length_2, half);
  const Four c = load(t.length_1, half), d = load(t.length_2, half);
  const Four other_1 = either(p.crossed, d, c), other_2 = either(p.crossed, c, d);
  const Four u = absolute(dot(p.between, load(f.first, half))), v = absolute(dot(p.between, load(f.second, half)));
  const Four off_1 = absolute(first - other_1), off_2 = absolute(second - other_2);
  const Mask equal = (off_1 <= kEqual * first) & (off_2 <= kEqual * second);
  const Four near_u = larger(u - first - other_1, all(0)), near_v = larger(v - second - other_2, all(0));
  const Four gap = p.height * p.height, line_u = gap + near_v * near_v, line_v = gap + near_u * near_u;
  const Four square = line_u + near_u * near_u, area = load(t.area, half);
  Bounds bounds =
      bounds_of(plan, p, half, gap / (square * square), square, p.delta + (off_1 + off_2), p.height, p.depth);
  bounds.usable &= p.opposite & equal;
  const Choice along_u = choose_nodes(bounds, first, first, cone(near_u, line_u), equal, 0.5);
  const Choice along_v = choose_nodes(bounds, second, second, cone(near_v, line_v), equal, 0.5);
  const Mask served = decide(plan, half, bounds, along_u, along_v, all(kOppositeAt));
  AlignedLanes& out = plan.lanes;
  const auto put = [&](Lanes& lanes, const Four& four) { store(lanes, half, either(served, four, load(lanes, half))); };
  put(out.u, u);
  put(out.v, v);
  put(out.first, first);
  put(out.second, second);
  put(out.squares[0], gap);
  put(out.factor, area / (16.0 * kPi) * gap);
}

[[gnu::always_inline]] inline void make_lanes(AlignedPlan& plan) {
  plan.key.fill(AlignedPlan::kNone);
  for (std::size_t half = 0; half < kHalves; ++half) {
    const Pairs pairs = classified(plan.from, plan.to, half);
    if (any(pairs.perpendicular)) plan_perpendicular(plan, pairs, half);
    if (any(pairs.opposite)) plan_opposite(plan, pairs, half);
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void make_wide(AlignedPlan& plan) {
  make_lanes(plan);
}
#else
void make_wide(AlignedPlan& plan) {
  make_lanes(plan);
}
#endif

void make_portable(AlignedPlan& plan) {
  make_lanes(plan);
}

}  // namespace

void PatchLanes::set(std::size_t lane, const Parallelogram& patch) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto axis = static_cast<Eigen::Index>(c);
    corner[c][lane] = patch.corner[axis];
    centre[c][lane] = patch.centre[axis];
    first[c][lane] = patch.direction[0][axis];
    second[c][lane] = patch.direction[1][axis];
    normal[c][lane] = patch.normal[axis];
  }
  length_1[lane] = patch.length[0];
  length_2[lane] = patch.length[1];
  radius[lane] = patch.radius;
  area[lane] = patch.area;
  shape[lane] = patch.shape;
  flatness[lane] = patch.flatness;
  const bool measurable = patch.valid && std::min(patch.length[0], patch.length[1]) > kShortest;
  skew[lane] = measurable ? patch.skew : 1;
}

void AlignedPlan::make(bool wide) {
  wide ? make_wide(*this) : make_portable(*this);
}

}  // namespace etendue
