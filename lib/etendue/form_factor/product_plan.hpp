// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/parallelogram.hpp"

namespace etendue {

/// Which product rule serves a pair of parallelograms, and the proved bound of what it gives. Derivation: NOTES.md §8.
struct ProductPlan {
  static constexpr int kLeastNodes = 2, kMostNodes = 9;

  enum class Kind {
    nothing,  ///< the two avert their faces or lie in one plane
    rule,
    other,  ///< another method has to serve
  } kind = Kind::other;
  std::uint32_t key = 0;  ///< nodes in the four directions, three bits each, less kLeastNodes
  double bound = 0;

  static int nodes(std::uint32_t key, int direction) {
    return kLeastNodes + static_cast<int>(key >> (3 * direction) & 7);
  }
};

[[nodiscard]] ProductPlan product_plan(const Parallelogram& from, const Parallelogram& to, const Tolerance& tolerance);

}  // namespace etendue
