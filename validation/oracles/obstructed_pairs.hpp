// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "oracles/obstructed_factor.hpp"

namespace etendue::oracle {

/// Families of random pairs with plates in between. In the first five a pair has one to three plates, one of which is
/// what the name says; the next three have one plate that touches a surface, the last one three that hide nearly all.
enum class PairFamily { floating, on_an_edge, on_a_vertex, hugging, tiny, standing, cornered, gapped, stacked };
inline constexpr std::array<PairFamily, 9> kPairFamilies{
    PairFamily::floating, PairFamily::on_an_edge, PairFamily::on_a_vertex, PairFamily::hugging, PairFamily::tiny,
    PairFamily::standing, PairFamily::cornered,   PairFamily::gapped,      PairFamily::stacked};
[[nodiscard]] std::string_view name(PairFamily family);

/// How many of a family the table holds: 1,000 in the first five, 1,000 that touch a surface, 27 that nearly do, 60 in the last.
inline constexpr int kMostPairs = 500;
constexpr int pairs_in(PairFamily family) {
  if (family == PairFamily::gapped) return 27;
  if (family == PairFamily::stacked) return 60;
  return family == PairFamily::standing || family == PairFamily::cornered ? kMostPairs : 200;
}

/// Number `index` of a family: always the same. Some light passes and some is stopped in most of them, not in all.
///
///     floating     anywhere between, leaning anyhow
///     on_an_edge   an edge lies in one of the two polygons
///     on_a_vertex  a corner lies in one of the two polygons, or is one of its corners
///     hugging      parallel to one of the two, above it by 10^-6 … 10^-2
///     tiny         of size 10^-3
///     standing     a partition stands on one of the two, its foot inside, across the border, or along an edge
///     cornered     a partition shares an edge with one of two polygons that themselves meet in an edge
///     gapped       the same, but a gap of 10^-5 … 10^-2 or a slant of as much parts it from one of the two
///     stacked      two plates across all of the way and a triangle between them: little is seen, along curves
[[nodiscard]] ObstructedPair obstructed_pair(PairFamily family, int index);

}  // namespace etendue::oracle
