// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "reference/pair_geometry.hpp"

// Ten families of pairs of planar regions, made again from counter-based random numbers wherever they are needed: the
// reference file holds only their form factors.
namespace etendue::validation::pairs {

inline constexpr const char* kFamilies[] = {"general",     "shared edge", "shared vertex", "coplanar neighbours",
                                            "standing on", "near-touch",  "size ratio",    "distance",
                                            "sliver",      "with holes"};
inline constexpr std::size_t kFamilyCount = 10;
inline constexpr std::size_t kPairsPerFamily = 1024;

struct Pair {
  Loops from, to;
  bool exact_frame = false;  ///< every coordinate is exact: what was meant to lie in a plane does
};

/// The pair `index` of `family`, in a frame of its own: by turns a rotation rounded to double, and a whole-numbered
/// rotation with a stretch, which keeps every coordinate exact.
Pair make(std::size_t family, std::size_t index);

}  // namespace etendue::validation::pairs
