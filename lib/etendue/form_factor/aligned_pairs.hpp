// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/parallelogram.hpp"
#include "etendue/form_factor/product_rule.hpp"

namespace etendue {

using Lanes = std::array<double, kLanes>;

/// Eight parallelograms side by side.
struct PatchLanes {
  std::array<Lanes, 3> corner{}, centre{}, first{}, second{}, normal{};
  Lanes length_1{}, length_2{}, radius{}, area{}, shape{}, flatness{}, skew{};

  void set(std::size_t lane, const Parallelogram& patch);
};

/// What the sums below need of eight pairs, and what they come to. Perpendicular pairs: `first` and `second` are the half
/// lengths along the common direction, squares[0 … 3] the sums of squared heights of near and far edges, `product` their
/// product of differences. Opposite pairs: half lengths along two directions, squares[0] the squared distance of the planes.
struct AlignedLanes {
  Lanes u{}, v{}, first{}, second{}, product{}, factor{};
  std::array<Lanes, 4> squares{};
  Lanes total{};
};

/// Which rule serves a pair of rectangles whose edges are parallel to one frame. Keys of one kind below kAlignedKeys:
/// pairs of the same key are summed side by side.
inline constexpr std::uint32_t kAlignedKeys = 2048;
inline constexpr std::uint32_t kNotAligned = kAlignedKeys;

/// Eight pairs at once: how each is served, and the proved bound of what comes out. The same operations in the same order in every
/// lane and with every instruction set; NOTES.md §8.
struct AlignedPlan {
  PatchLanes from, to;
  Lanes absolute{};  ///< asked for
  double relative = 0;

  AlignedLanes lanes;  ///< to be summed, each with others of its key
  Lanes bound{};
  std::array<std::uint32_t, kLanes> key{};  ///< kNotAligned where another rule has to

  void make(bool wide);
};

/// Fills `total`: the form factors of eight pairs of one key.
void sum_aligned(AlignedLanes& lanes, std::uint32_t key, bool wide);

}  // namespace etendue
