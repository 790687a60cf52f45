// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/exact_exchange.hpp"

#include <algorithm>
#include <cstdint>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

std::vector<Polygon> polygons_of(const ElementMesh& mesh) {
  std::vector<Polygon> polygons;
  polygons.reserve(mesh.elements.size());
  for (const Element& element : mesh.elements) polygons.push_back(element.polygon);
  return polygons;
}

/// So that the absolute error holds for the factor from either side: it is larger from the smaller surface.
Tolerance of_both(Tolerance asked, const Polygon& first, const Polygon& second) {
  asked.absolute *= std::min(first.area(), second.area()) / std::max(first.area(), second.area());
  return asked;
}

Bounded exchange(const Bounded& factor, double area) {
  const double value = factor.value * area;
  return {value, (factor.bound * area + kUnitRoundoff * value) * (1 + gamma_bound(4))};
}

/// F_ij ≤ the unobstructed factor ≤ min(1, A_j/A_i) holds for the truth. A value held there is off by no more than before,
/// or by no more than the limit is.
Bounded held(Bounded value, const Bounded& most, TileReport& report) {
  if (value.value > most.value) {
    ++report.clamped;
    value = {most.value, std::max(value.bound, most.bound)};
  }
  return value;
}

}  // namespace

ExactExchange::ExactExchange(const ElementMesh& mesh, const AssemblyTolerance& tolerance)
    : mesh_(mesh),
      sights_(mesh),
      rows_(polygons_of(mesh)),
      tolerance_{with_room(tolerance.free), with_room(tolerance.obstructed)} {}

std::vector<SeenPair> ExactExchange::factors(std::span<const SurfacePair> pairs, AbsoluteError error) const {
  std::vector<SeenPair> seen(pairs.size());
  std::vector<IndexPair> there, back;
  std::vector<std::size_t> clear, checked;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const SightLine line = sights_.between(i, j);
    seen[k].sight = line.sight;
    if (line.sight == Sight::clear) {
      const auto first = static_cast<std::uint32_t>(i), second = static_cast<std::uint32_t>(j);
      there.push_back({first, second});
      clear.push_back(k);
      if ((i + j) % kCheckedClearPairs != 0) continue;
      back.push_back({second, first});
      checked.push_back(k);
    } else if (line.sight == Sight::undecided) {
      const ElementPair pair{mesh_.elements[i].polygon, mesh_.elements[j].polygon, line.bodies};
      AssemblyTolerance asked = tolerance_;
      if (error == AbsoluteError::of_both) asked.obstructed = of_both(asked.obstructed, pair.first, pair.second);
      seen[k].found =
          (i + j) % kCheckedObstructedPairs == 0 ? two_sided_factor(pair, asked) : one_sided_factor(pair, asked);
    }
  }
  std::vector<Bounded> found(there.size());
  rows_.pairs(there, tolerance_.free, error, found);
  for (std::size_t k = 0; k < clear.size(); ++k) {
    seen[clear[k]].found.factor = found[k];
    seen[clear[k]].found.free = found[k];
  }
  found.resize(back.size());
  rows_.pairs(back, tolerance_.free, error, found);
  for (std::size_t k = 0; k < checked.size(); ++k) {
    PairFactor& pair = seen[checked[k]].found;
    const double ratio = mesh_.elements[back[k].to].polygon.area() / mesh_.elements[back[k].from].polygon.area();
    pair = compared_factor(pair.factor, found[k], ratio);
    pair.free = pair.factor;
  }
  return seen;
}

void ExactExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const {
  const std::vector<SeenPair> seen = factors(pairs, AbsoluteError::of_both);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double area = mesh_.elements[pairs[k].i].polygon.area();
    const Bounded whole{std::min(area, mesh_.elements[pairs[k].j].polygon.area()), 0};
    const PairFactor& found = seen[k].found;
    exchanges[k] = {0, 0};
    switch (seen[k].sight) {
      case Sight::averted:
        ++report.averted;
        continue;
      case Sight::blocked:
        ++report.blocked;
        continue;
      case Sight::clear:
        ++report.clear;
        exchanges[k] = held(exchange(found.factor, area), whole, report);
        break;
      case Sight::undecided: {
        ++report.obstructed;
        const Bounded free = exchange(found.free, area);
        const std::uint64_t before = report.clamped;
        exchanges[k] = held(exchange(found.factor, area), free.value < whole.value ? free : whole, report);
        if (found.clamped && report.clamped == before) ++report.clamped;
        break;
      }
    }
    if (!found.checked) continue;
    ++report.checked;
    if (!found.agree) ++report.disagreements;
    report.defect = std::max(report.defect, found.difference);
  }
}

std::vector<std::size_t> ExactExchange::blockers(const SurfacePair& pair) const {
  return sights_.between(pair.i, pair.j).blockers;
}

}  // namespace etendue
