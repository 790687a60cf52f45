// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/blocker.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// The absolute error asked of a factor, as a share of the relative one. A row Σ_j max(relative · F_ij, absolute) errs by
/// at most relative + n absolute, so up to 1,000 elements the many small factors add no more than the large ones do.
inline constexpr double kAbsoluteShare = 1e-3;

/// What is asked of the single form factors; NOTES.md §3 derives the numbers.
struct AssemblyTolerance {
  Tolerance free{1e-12, 1e-12 * kAbsoluteShare};      ///< where nothing comes between
  Tolerance obstructed{1e-6, 1e-6 * kAbsoluteShare};  ///< where faces do
};

/// How often the two sides of a pair may be quartered to make them agree. Most do after one; NOTES.md §2 has the counts.
inline constexpr int kMostQuarterings = 7;

/// Two elements and the faces that may stand between them.
struct ElementPair {
  const Polygon& first;
  const Polygon& second;
  std::vector<const Blocker*> blockers;  ///< whoever made them keeps them alive
  std::optional<Bounded> free{};         ///< F_12 without them, to kFreeShare of the tolerance; where it is known
};

/// A form factor, and what is known of it from the other side.
struct PairFactor {
  Bounded factor;         ///< F_12, and a bound on |F_12 − exact|; F_21 is A_1 F_12 / A_2
  Bounded free;           ///< F_12 without the blockers
  bool clamped = false;   ///< was a side held at 0 or at the free factor (ObstructedFormFactor::clamp)?
  bool checked = false;   ///< computed from both sides?
  bool agree = true;      ///< do the two differ by no more than their bounds?
  int quarterings = 0;    ///< after how many they did
  double difference = 0;  ///< |A_1 F_12 − A_2 F_21| / max(A_1, A_2) at the end
};

/// What two sides, each computed on its own, say of a pair with nothing between.               @eq IU.6-5
///
/// Symbols   there F_12; back F_21; area_ratio A_1/A_2
/// Returns   the larger value, with the largest of the two bounds and the difference
[[nodiscard]] PairFactor compared_factor(const Bounded& there, const Bounded& back, double area_ratio);

/// Of the pairs with something between them, one in so many is computed from both sides; the measurements of NOTES.md §2
/// say why not all.
inline constexpr std::size_t kCheckedObstructedPairs = 16;

/// F_12 from the first element's side; from both where curves of three edges cross it.               @eq IU.6-4
///
/// Accuracy  as obstructed_form_factor(): measured
[[nodiscard]] PairFactor one_sided_factor(const ElementPair& pair, const AssemblyTolerance& tolerance);

/// F_12 computed from both sides: the larger value, since what an adaptive rule overlooks is a narrow gap, with the
/// larger of the two bounds and the difference. Where the two differ by more than their bounds or the tolerance, both
/// elements are quartered and each side is summed over its parts, until they agree or a part misses its tolerance.                            @eq IU.6-4, IU.6-5
///
/// Accuracy  measured (NOTES.md §2): a gap that both sides overlook stays overlooked
[[nodiscard]] PairFactor two_sided_factor(const ElementPair& pair, const AssemblyTolerance& tolerance);

/// The error that `tolerance` allows a factor F_12: the looser of what it allows F_12 itself and, through A_1 F_12 =
/// A_2 F_21, what it allows F_21. Both sides are computed to it, so neither can be held to less.
[[nodiscard]] double allowed_error(const Tolerance& tolerance, double factor, double area_ratio);

}  // namespace etendue
