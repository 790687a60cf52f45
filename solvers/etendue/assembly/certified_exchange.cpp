// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/certified_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/certified.hpp"

namespace etendue {

namespace {

/// Newell's sum of up to 2^16 vertices in double-double, its length, a half: relative error of Polygon::area().
constexpr double kAreaRounding = 16 * kUnitRoundoff;

Bounded middle(const Interval& factor, double area) {
  const double value = factor.middle() * area;
  const double reach = std::max(factor.upper - factor.middle(), factor.middle() - factor.lower);
  return {value, (reach * area + kAreaRounding * value) * (1 + gamma_bound(8))};
}

}  // namespace

CertifiedExchange::CertifiedExchange(const ElementMesh& mesh, const Tolerance& tolerance)
    : mesh_(mesh), sights_(mesh), tolerance_(tolerance) {
  constexpr double kRoomForRounding = 1 - 0x1p-10;
  tolerance_.relative *= kRoomForRounding;
  tolerance_.absolute *= kRoomForRounding;
}

void CertifiedExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges,
                             TileReport& report) const {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const Sight sight = sights_.between(i, j).sight;
    exchanges[k] = {0, 0};
    if (sight == Sight::averted) ++report.averted;
    if (sight == Sight::blocked) ++report.blocked;
    if (sight == Sight::averted || sight == Sight::blocked) continue;
    const Polygon& first = mesh_.elements[i].polygon;
    const Polygon& second = mesh_.elements[j].polygon;
    CertifiedGoal goal;
    goal.tolerance = tolerance_;
    goal.tolerance.absolute *= std::min(first.area(), second.area()) / std::max(first.area(), second.area());
    Interval factor = certified_form_factor(first, second, goal).factor;
    if (sight == Sight::undecided) {
      ++report.obstructed;
      factor.lower = 0;
    } else {
      ++report.clear;
    }
    exchanges[k] = middle(factor, first.area());
  }
}

std::vector<std::size_t> CertifiedExchange::blockers(const SurfacePair& pair) const {
  return sights_.between(pair.i, pair.j).blockers;
}

}  // namespace etendue
