// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "etendue/form_factor/difference_rule.hpp"
#include "etendue/form_factor/product_rule.hpp"

namespace etendue {

using Lanes = std::array<double, kLanes>;

/// What the sums below need of eight pairs of rectangles in one frame, and what they come to: form factors. Lengths are
/// those of half edges.
struct AlignedLanes {
  Lanes u{}, v{};           ///< between the centres, along the common direction; opposite ones: along both edges
  Lanes first{}, second{};  ///< of the two rectangles along the common direction; opposite ones: of either along both
  std::array<Lanes, 4> squares{};  ///< s² + t² of near and far edges: 11, 12, 21, 22; opposite ones: the gap's, first
  Lanes product{};                 ///< (s_2² − s_1²)(t_2² − t_1²); opposite ones do not use it
  Lanes factor{};                  ///< of the sum
  Lanes total{};
};

/// A rule's number: nodes along the first direction less kLeastNodes; for perpendicular pairs + kTermsAt times the terms
/// of the series less kLeastTerms + kEqualAt where the common edges are equal; for opposite ones + kTermsAt times the
/// nodes along the second direction less kLeastNodes + kOppositeAt.
namespace aligned {
inline constexpr int kLeastNodes = 2;
inline constexpr int kMostProductNodes = 9;  ///< along either of two unequal edges
inline constexpr int kLeastTerms = 2, kMostTerms = 9;
inline constexpr std::size_t kRules = kMostDifferenceNodes - kLeastNodes + 1;
inline constexpr std::uint32_t kTermsAt = 32, kEqualAt = 256, kOppositeAt = 1024;
inline constexpr std::uint32_t kKeys = 2048;
static_assert(kRules <= kTermsAt && (kMostTerms - kLeastTerms + 1) * kTermsAt <= kEqualAt);
static_assert(2 * kEqualAt <= kOppositeAt && kOppositeAt + kRules * kTermsAt <= kKeys);
}  // namespace aligned

/// Fills `total`: the form factors of eight pairs of one key. The same operations in the same order in every lane and with
/// every instruction set. Derivation and bound: NOTES.md §8.
void sum_aligned(AlignedLanes& lanes, std::uint32_t key, bool wide);

}  // namespace etendue
