// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/core/split_mix.hpp"

namespace etendue {

/// Place of thing `index` of n when they are shuffled as `shuffle` says: all n have different ones.
[[nodiscard]] std::uint64_t shuffled(std::uint64_t index, std::uint64_t n, std::uint64_t shuffle);

/// What a sample draws its random numbers from: a counter, not a generator that goes on. Who asks for number k of a sample
/// gets the same one, whatever was asked before and on whichever thread; other samples' numbers have nothing to do with it.
struct SampleKey {
  std::uint64_t bits = 0;
  std::uint64_t pixel = 0;  ///< what it has in common with the other samples of its pixel
  int index = 0, side = 1;  ///< which of side × side samples it is

  /// Number k of the sample, in [0, 1).
  double number(std::uint64_t k) const { return unit_interval(split_mix(bits + (k + 1) * kGoldenStep)); }

  /// Number k, spread: each of the pixel's N² samples has it in another one of N² equal parts of [0, 1].  @eq IU.5.8.1
  double spread(std::uint64_t k) const {
    const auto count = static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
    const std::uint64_t place = shuffled(static_cast<std::uint64_t>(index), count, split_mix(pixel + k));
    return (static_cast<double>(place) + number(k)) / static_cast<double>(count);
  }

  /// Numbers k and k + 1, spread: each of the N² samples has them in another one of N × N equal parts of the unit square.
  struct Pair {
    double first, second;
  };
  Pair spread_pair(std::uint64_t k) const {
    const auto n = static_cast<std::uint64_t>(side);
    const std::uint64_t place = shuffled(static_cast<std::uint64_t>(index), n * n, split_mix(pixel + k));
    return {(static_cast<double>(place % n) + number(k)) / side,
            (static_cast<double>(place / n) + number(k + 1)) / side};
  }

  /// The key of part k of the sample, with numbers of its own.
  SampleKey part(std::uint64_t k) const {
    const std::uint64_t step = (k + 1) * kGoldenStep;
    return {split_mix((bits ^ kGoldenStep) + step), split_mix((pixel ^ kGoldenStep) + step), index, side};
  }
};

/// Numbers of a sample, by what they decide.
namespace sample_number {
inline constexpr std::uint64_t kAcross = 0, kDown = 1;       ///< its place in the pixel
inline constexpr std::uint64_t kStratum = 2;                 ///< which part of the pixel is looked at first
inline constexpr std::uint64_t kLensOut = 3, kLensTurn = 4;  ///< where the ray leaves the lens
inline constexpr std::uint64_t kShade = 5;                   ///< part of the key that surfaces and lights draw from
inline constexpr std::uint64_t kWavelength = 6;  ///< where in each part of the visible light its wavelength lies
inline constexpr std::uint64_t kTime = 7;        ///< when the ray travels
inline constexpr std::uint64_t kTree = 8;        ///< part of the key that the rays of the tree draw from
inline constexpr std::uint64_t kFrost = 0;       ///< of such a ray, and the next number: how it strays
}  // namespace sample_number

/// The key of sample `index` of the pixel in `column` and `row`, of `side` × `side` that it may have.
[[nodiscard]] inline SampleKey sample_key(std::uint64_t seed, int column, int row, int index, int side = 1) {
  const auto place = static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32 |
                     static_cast<std::uint64_t>(static_cast<std::uint32_t>(column));
  const std::uint64_t pixel = split_mix(split_mix(seed + kGoldenStep) ^ place);
  SampleKey key = SampleKey{pixel}.part(static_cast<std::uint64_t>(index));
  key.pixel = pixel;
  key.index = index % (side * side);
  key.side = side;
  return key;
}

}  // namespace etendue
