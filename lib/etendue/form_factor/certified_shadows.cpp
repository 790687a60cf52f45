// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified_shadows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "etendue/form_factor/common_shadow.hpp"

namespace etendue {

namespace {

using Mask = std::uint32_t;

/// More sets of blockers than this are not asked for what they hide together; a mask holds at most 31 blockers.
constexpr std::size_t kMostSets = 128;
/// Up to this share of the goal a shadow counts as none.
constexpr double kNothing = 0.01;

/// Larger sets out of those that hide something together, each made once: by adding a blocker beyond its last.
std::vector<Mask> larger(const std::vector<Mask>& sets, const std::vector<Mask>& single) {
  std::vector<Mask> next;
  for (const Mask set : sets) {
    for (const Mask one : single) {
      if (one > set) next.push_back(set | one);
    }
  }
  return next;
}

/// Inclusion and exclusion, level by level: after an odd number of levels the sum is not below what all hide, after an
/// even number not above (Bonferroni), so the sums also serve where the sets grow too many.
HiddenFlux united_shadows(const Interval3& corner, const SourceTriangle& source, const SignedPart& part,
                          const std::vector<EnclosedBlocker>& blockers, double goal, std::int64_t budget) {
  std::vector<Mask> single;
  for (std::size_t k = 0; k < blockers.size(); ++k) single.push_back(Mask{1} << k);
  std::vector<Mask> level = single;
  Interval sum;
  HiddenFlux result;
  double most = std::numeric_limits<double>::infinity(), least = 0, ignored = 0, share = goal;
  for (double sign = 1; !level.empty(); sign = -sign) {
    if (blockers.size() > 1) share *= 0.5;
    std::vector<Mask> kept;
    Interval added;
    double left = static_cast<double>(level.size());
    for (const Mask set : level) {
      std::vector<const EnclosedBlocker*> together;
      for (std::size_t k = 0; k < blockers.size(); ++k) {
        if ((set >> k & 1u) != 0) together.push_back(&blockers[k]);
      }
      const auto allowed =
          static_cast<std::int64_t>(static_cast<double>(budget - result.work) / (blockers.size() > 1 ? left + 1 : 1));
      left -= 1;
      const HiddenFlux one = common_shadow(corner, source, part, together, share / static_cast<double>(level.size()),
                                           std::max<std::int64_t>(1, allowed));
      result.work += one.work;
      result.enclosed = result.enclosed && one.enclosed;
      added = added + one.flux;
      if (together.size() == 1) least = std::max(least, one.flux.lower);
      // What hides next to nothing hides no more together with others: all sets with it count as that much, or none.
      const double others = std::ldexp(one.flux.upper, static_cast<int>(blockers.size() - together.size()));
      if (others <= kNothing * goal) {
        ignored = above(ignored + others);
      } else {
        kept.push_back(set);
      }
    }
    sum = sign > 0 ? sum + added : sum - added;
    if (sign > 0) most = std::min(most, sum.upper);
    if (sign < 0) least = std::max(least, sum.lower);
    const std::vector<Mask> next = larger(kept, sign > 0 && level.size() == single.size() ? (single = kept) : single);
    if (next.empty()) {
      least = std::max(least, sum.lower);
      most = std::min(most, sum.upper);
    }
    if (next.size() > kMostSets) break;
    level = next;
  }
  result.flux = Interval(std::min(least, most), most) + Interval(-ignored, ignored);
  return result;
}

}  // namespace

HiddenFlux hidden_flux(const EnclosedPair& pair, const std::vector<std::vector<Vec3>>& blockers, double goal,
                       std::int64_t budget) {
  std::vector<EnclosedBlocker> planes;
  for (const auto& b : blockers) planes.push_back({b, ExactPlane(b)});
  const std::vector<SignedPart> parts = pair.flat ? signed_parts(pair.to) : signed_triangles(pair.to);
  const auto pieces = static_cast<double>((pair.from.size() - 2) * parts.size());
  const auto share = std::max<std::int64_t>(1, static_cast<std::int64_t>(static_cast<double>(budget) / pieces));
  HiddenFlux total;
  const Interval3 front = doubled_area_of(pair.from);
  for (std::size_t i = 1; i + 1 < pair.from.size(); ++i) {
    SourceTriangle source{pair.from[i] - pair.from[0], pair.from[i + 1] - pair.from[0], {}};
    source.normal = cross(source.along, source.across);
    // The fan of a concave source has triangles that turn the other way: what they hand over is taken off.
    const Interval turn = dot(front, source.normal);
    const double sign = turn.middle() >= 0 ? 1 : -1;
    if (sign < 0) {
      std::swap(source.along, source.across);
      source.normal = -source.normal;
    }
    const double area = turn.contains(0.0) ? norm(source.normal).upper : 0;
    total.flux = total.flux + Interval(-area, area);
    for (const SignedPart& part : parts) {
      const HiddenFlux one = united_shadows(pair.from[0], source, part, planes, goal / pieces, share);
      total.flux = sign * part.sign > 0 ? total.flux + one.flux : total.flux - one.flux;
      total.flux = total.flux + Interval(-part.uncertain, part.uncertain);
      total.work += one.work;
      total.enclosed = total.enclosed && one.enclosed;
    }
  }
  return total;
}

}  // namespace etendue
