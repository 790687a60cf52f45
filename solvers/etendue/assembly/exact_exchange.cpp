// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/exact_exchange.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/obstructed.hpp"

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

/// Pairs that need work: their places among those asked for, and what FactorRows is asked.
struct ExactExchange::Tile {
  std::span<const SurfacePair> pairs;
  std::vector<std::size_t> clear, obstructed;
  std::vector<SightLine> lines;  ///< of the obstructed ones

  std::vector<IndexPair> named(const std::vector<std::size_t>& places) const {
    std::vector<IndexPair> result;
    result.reserve(places.size());
    for (const std::size_t k : places) {
      result.push_back({static_cast<std::uint32_t>(pairs[k].i), static_cast<std::uint32_t>(pairs[k].j)});
    }
    return result;
  }
};

std::vector<SeenPair> ExactExchange::factors(std::span<const SurfacePair> pairs, AbsoluteError error) const {
  std::vector<SeenPair> seen(pairs.size());
  Tile tile{pairs, {}, {}, {}};
  Approach approach;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    SightLine line = sights_.between(pairs[k].i, pairs[k].j, approach);
    seen[k].sight = line.sight;
    if (line.sight == PairSight::clear) tile.clear.push_back(k);
    if (line.sight != PairSight::undecided) continue;
    tile.obstructed.push_back(k);
    tile.lines.push_back(std::move(line));
  }
  find_clear(tile, error, seen);
  find_obstructed(tile, error, seen);
  return seen;
}

void ExactExchange::find_clear(const Tile& tile, AbsoluteError error, std::vector<SeenPair>& seen) const {
  const std::vector<IndexPair> there = tile.named(tile.clear);
  std::vector<Bounded> found(there.size());
  rows_.pairs(there, tolerance_.free, error, found);
  std::vector<IndexPair> back;
  std::vector<std::size_t> checked;
  for (std::size_t k = 0; k < there.size(); ++k) {
    const std::size_t place = tile.clear[k];
    seen[place].found.factor = found[k];
    seen[place].found.free = found[k];
    if ((std::size_t{there[k].from} + there[k].to) % kCheckedClearPairs != 0) continue;
    back.push_back({there[k].to, there[k].from});
    checked.push_back(place);
  }
  found.resize(back.size());
  rows_.pairs(back, tolerance_.free, error, found);
  for (std::size_t k = 0; k < checked.size(); ++k) {
    PairFactor& pair = seen[checked[k]].found;
    const double ratio = mesh_.elements[back[k].to].polygon.area() / mesh_.elements[back[k].from].polygon.area();
    pair = compared_factor(pair.factor, found[k], ratio);
    pair.free = pair.factor;
  }
}

void ExactExchange::find_obstructed(const Tile& tile, AbsoluteError error, std::vector<SeenPair>& seen) const {
  std::vector<Bounded> free(tile.obstructed.size());
  rows_.pairs(tile.named(tile.obstructed), free_share(tolerance_.obstructed), error, free);
  for (std::size_t k = 0; k < tile.obstructed.size(); ++k) {
    const auto [i, j] = tile.pairs[tile.obstructed[k]];
    ElementPair pair{mesh_.elements[i].polygon, mesh_.elements[j].polygon, tile.lines[k].bodies, {}};
    AssemblyTolerance asked = tolerance_;
    if (error == AbsoluteError::of_both) asked.obstructed = of_both(asked.obstructed, pair.first, pair.second);
    // From the smaller of the two less is asked of a free factor than of an obstructed one.
    const Tolerance& least = asked.obstructed;
    if (free[k].bound <= kFreeShare * std::max(least.absolute, least.relative * free[k].value)) pair.free = free[k];
    seen[tile.obstructed[k]].found =
        (i + j) % kCheckedObstructedPairs == 0 ? two_sided_factor(pair, asked) : one_sided_factor(pair, asked);
  }
}

void ExactExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const {
  const std::vector<SeenPair> seen = factors(pairs, AbsoluteError::of_both);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double area = mesh_.elements[pairs[k].i].polygon.area();
    const Bounded whole{std::min(area, mesh_.elements[pairs[k].j].polygon.area()), 0};
    const PairFactor& found = seen[k].found;
    exchanges[k] = {0, 0};
    switch (seen[k].sight) {
      case PairSight::averted:
        ++report.averted;
        continue;
      case PairSight::blocked:
        ++report.blocked;
        continue;
      case PairSight::clear:
        ++report.clear;
        exchanges[k] = held(exchange(found.factor, area), whole, report);
        break;
      case PairSight::undecided: {
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
