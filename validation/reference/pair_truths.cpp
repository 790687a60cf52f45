// SPDX-License-Identifier: Apache-2.0
// Generator of pair_truths.txt: the form factors of the ten families of pair_families.hpp, each as a ball.
//   cmake --build <dir> --target pair-truths; <dir>/bin/pair-truths > validation/reference/pair_truths.txt
//   pair-truths FAMILY FIRST LAST      prints that part only
// Each line: the bits of the double nearest to F, those of the float nearest to the rest, and −log2 of the radius
// relative to F, in hexadecimal.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "oracles/pair_contour.hpp"
#include "reference/pair_families.hpp"

namespace {

using namespace etendue;

/// What lies nearer to a plane than this share of the size is meant to lie in it, in the frames that round.
constexpr double kRoundedPlanarity = 1e-13;
constexpr double kClear = 1e-9;

bool print(std::size_t family, std::size_t index) {
  const validation::pairs::Pair pair = validation::pairs::make(family, index);
  const auto f = oracle::pair_contour(pair.from, pair.to, pair.exact_frame ? 0 : kRoundedPlanarity);
  const auto rest = static_cast<float>(f.low);
  const double radius = f.radius + std::abs(f.low - static_cast<double>(rest));
  const double relative = f.high > 0 ? radius / f.high : radius;
  const int bits = relative > 0 ? std::clamp(-1 - std::ilogb(relative), 0, 255) : 255;
  std::printf("%016llx %08x %02x\n", static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(f.high)),
              std::bit_cast<std::uint32_t>(rest), static_cast<unsigned>(bits));
  constexpr int kUseful = 38;  // bits: hairs between nearly parallel edges cost the rest
  if (bits >= kUseful && (pair.exact_frame || f.margin >= kClear)) return true;
  std::fprintf(stderr, "%s %zu missed its case: F %g, 2^-%d, margin %g\n", validation::pairs::kFamilies[family], index,
               f.high, bits, f.margin);
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  bool good = true;
  if (argc == 4) {
    const auto number = [&](int i) { return static_cast<std::size_t>(std::stoul(argv[i])); };
    for (std::size_t i = number(2); i < number(3); ++i) good = print(number(1), i) && good;
    return good ? 0 : 1;
  }
  for (std::size_t family = 0; family < validation::pairs::kFamilyCount; ++family) {
    for (std::size_t i = 0; i < validation::pairs::kPairsPerFamily; ++i) good = print(family, i) && good;
  }
  return good ? 0 : 1;
}
