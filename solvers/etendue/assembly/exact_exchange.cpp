// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/exact_exchange.hpp"

#include <algorithm>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// Asked for in place of the whole tolerance, so that a bound that just reaches it still does after the roundings that
/// lead to the exchange area.
constexpr double kRoomForRounding = 1 - 0x1p-10;

/// A pair of elements; all in exchange areas.
struct Pair {
  ElementPair elements;
  const AssemblyTolerance& tolerance;

  /// So that the absolute error holds for the factor from either side: it is larger from the smaller surface.
  Tolerance asked(Tolerance wanted) const {
    const double first = elements.first.area(), second = elements.second.area();
    wanted.relative *= kRoomForRounding;
    wanted.absolute *= kRoomForRounding * std::min(first, second) / std::max(first, second);
    return wanted;
  }
  AssemblyTolerance asked() const { return {asked(tolerance.free), asked(tolerance.obstructed)}; }

  Bounded exchange(const Bounded& factor) const {
    const double area = elements.first.area(), value = factor.value * area;
    return {value, (factor.bound * area + kUnitRoundoff * value) * (1 + gamma_bound(4))};
  }

  /// F_ij ≤ the unobstructed factor ≤ min(1, A_j/A_i) holds for the truth. A value held there is off by no more than
  /// before, or by no more than the limit is.
  Bounded held(Bounded value, const Bounded& unobstructed, TileReport& report) const {
    Bounded most{std::min(elements.first.area(), elements.second.area()), 0};
    if (unobstructed.value < most.value) most = unobstructed;
    if (value.value > most.value) {
      ++report.clamped;
      value = {most.value, std::max(value.bound, most.bound)};
    }
    return value;
  }

  Bounded find(bool from_both_sides, TileReport& report) const {
    const PairFactor found =
        from_both_sides ? two_sided_factor(elements, asked()) : one_sided_factor(elements, asked());
    if (found.checked) {
      ++report.checked;
      if (!found.agree) ++report.disagreements;
      report.defect = std::max(report.defect, found.difference);
    }
    return held(exchange(found.factor), exchange(found.free), report);
  }
};

}  // namespace

ExactExchange::ExactExchange(const ElementMesh& mesh, const AssemblyTolerance& tolerance)
    : mesh_(mesh), sights_(mesh), tolerance_(tolerance) {}

void ExactExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const SightLine line = sights_.between(i, j);
    Pair pair{{mesh_.elements[i].polygon, mesh_.elements[j].polygon, {}}, tolerance_};
    switch (line.sight) {
      case Sight::averted:
        ++report.averted;
        exchanges[k] = {0, 0};
        break;
      case Sight::blocked:
        ++report.blocked;
        exchanges[k] = {0, 0};
        break;
      case Sight::clear:
        ++report.clear;
        exchanges[k] = pair.find((i + j) % kCheckedClearPairs == 0, report);
        break;
      case Sight::undecided:
        ++report.obstructed;
        pair.elements.blockers = line.bodies;
        exchanges[k] = pair.find(true, report);
        break;
    }
  }
}

std::vector<std::size_t> ExactExchange::blockers(const SurfacePair& pair) const {
  return sights_.between(pair.i, pair.j).blockers;
}

}  // namespace etendue
