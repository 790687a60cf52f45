// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// The increment of SplitMix64: 2^64 over the golden ratio, odd.
inline constexpr std::uint64_t kGoldenStep = 0x9e3779b97f4a7c15u;

/// SplitMix64's finalizer: spreads what a counter says over all bits, the same with every compiler.
///
/// Source    Steele, Lea and Flood 2014, doi:10.1145/2660193.2660195
[[nodiscard]] constexpr std::uint64_t split_mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// The leading 53 bits as a number in [0, 1).
[[nodiscard]] constexpr double unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace etendue
