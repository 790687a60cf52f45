// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "etendue/form_factor/aligned_rule.hpp"
#include "etendue/form_factor/parallelogram.hpp"

namespace etendue {

/// Eight parallelograms side by side.
struct PatchLanes {
  std::array<Lanes, 3> corner{}, centre{}, first{}, second{}, normal{};
  Lanes length_1{}, length_2{}, radius{}, area{}, shape{}, flatness{}, skew{};

  void set(std::size_t lane, const Parallelogram& patch);
};

/// Eight pairs at once: which of them are rectangles in one frame, at a right angle or opposite to one another, which rule
/// serves each, and the proved bound of what that rule gives. The same operations in the same order in every lane and with
/// every instruction set. Derivation: NOTES.md §8.
struct AlignedPlan {
  static constexpr std::uint32_t kNone = aligned::kKeys;

  PatchLanes from, to;
  Lanes absolute{};  ///< error asked
  double relative = 0;

  AlignedLanes lanes;  ///< to be summed, each with others of its key
  Lanes bound{};
  std::array<std::uint32_t, kLanes> key{};  ///< of sum_aligned(); kNone: another method has to serve

  void make(bool wide);
};

}  // namespace etendue
