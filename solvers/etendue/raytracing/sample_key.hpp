// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/core/split_mix.hpp"

namespace etendue {

/// What a sample draws its random numbers from: a counter, not a generator that goes on. Who asks for number k of a sample
/// gets the same one, whatever was asked before and on whichever thread; other samples' numbers have nothing to do with it.
struct SampleKey {
  std::uint64_t bits = 0;

  /// Number k of the sample, in [0, 1).
  double number(std::uint64_t k) const { return unit_interval(split_mix(bits + (k + 1) * kGoldenStep)); }

  /// The key of part k of the sample, with numbers of its own.
  SampleKey part(std::uint64_t k) const { return {split_mix((bits ^ kGoldenStep) + (k + 1) * kGoldenStep)}; }
};

/// Numbers of a sample, by what they decide.
namespace sample_number {
inline constexpr std::uint64_t kAcross = 0, kDown = 1;       ///< its place in the pixel
inline constexpr std::uint64_t kStratum = 2;                 ///< which part of the pixel is looked at first
inline constexpr std::uint64_t kLensOut = 3, kLensTurn = 4;  ///< where the ray leaves the lens
inline constexpr std::uint64_t kShade = 5;                   ///< part of the key that surfaces and lights draw from
inline constexpr std::uint64_t kWavelength = 6;  ///< where in each part of the visible light its wavelength lies
}  // namespace sample_number

/// The key of sample `index` of the pixel in `column` and `row`.
[[nodiscard]] inline SampleKey sample_key(std::uint64_t seed, int column, int row, int index) {
  const auto pixel = static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32 |
                     static_cast<std::uint64_t>(static_cast<std::uint32_t>(column));
  return SampleKey{split_mix(split_mix(seed + kGoldenStep) ^ pixel)}.part(static_cast<std::uint64_t>(index));
}

}  // namespace etendue
