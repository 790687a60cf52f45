// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/sample_key.hpp"

#include <bit>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// Enough for each bit of the place to hang on each bit of the index.
constexpr int kRounds = 4;

/// A permutation of [0, 2^bits): multiplications by odd numbers and shifts to the right can be undone.
std::uint64_t stirred(std::uint64_t x, int bits, std::uint64_t shuffle) {
  const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  const int half = (bits + 1) / 2;
  for (int round = 0; round < kRounds; ++round) {
    shuffle = split_mix(shuffle + kGoldenStep);
    x = (x * (shuffle | 1) + (shuffle >> 32)) & mask;
    x ^= x >> half;
  }
  return x;
}

}  // namespace

std::uint64_t shuffled(std::uint64_t index, std::uint64_t n, std::uint64_t shuffle) {
  require(index < n && n <= (std::uint64_t{1} << 32), "shuffled: the index is one of n");
  if (n == 1) return 0;
  const int bits = static_cast<int>(std::bit_width(n - 1));
  // What lies beyond n goes on until it comes back: then none of n is met twice.
  do {
    index = stirred(index, bits, shuffle);
  } while (index >= n);
  return (index + (split_mix(shuffle) >> 32)) % n;
}

}  // namespace etendue
