// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "etendue/form_factor/certified_parts.hpp"
#include "etendue/form_factor/certified_shadows.hpp"
#include "etendue/form_factor/shadow_hull.hpp"

namespace etendue {

/// Two surfaces that face one another, and what blockers keep away, by shadow hulls: whatever the blockers are and however
/// they meet, there is an answer.
///
/// The source is cut into triangles. From each, what the outer shadows (the hull of all shadows from it) leave free is
/// seen, what lies in an inner shadow (common to all shadows from it) is not; what is between is not known. The triangle
/// that leaves the most open is quartered next.
///
/// Domain    convex blockers scaled as the pair is, any number; `from` and `to` the planes of the two polygons
/// Accuracy  inclusion proved: NOTES.md §14
/// Errors    none
/// Source    Nishita and Nakamae 1985 for umbra and penumbra volumes of convex blockers
class HullPair {
 public:
  /// All must outlive it.
  HullPair(const EnclosedPair& pair, const ExactPlane& from, const ExactPlane& to);

  /// Where a plane keeps a blocker out of all lines between the two: the flux that it takes all the same, at most, since
  /// it was drawn in before this could be shown; next to nothing.
  [[nodiscard]] std::optional<double> lost_past(const std::vector<Vec3>& blocker) const;

  /// The same flux as etendue::hidden_flux(); half its width is about `goal` unless `budget` was spent before. Ends always:
  /// the width falls like one over the root of the work.
  [[nodiscard]] HiddenFlux hidden_flux(const std::vector<std::vector<Vec3>>& blockers, double goal,
                                       std::int64_t budget) const;

 private:
  struct Part {
    ReceiverPiece corners;
    double sign;
  };
  static std::vector<Part> rounded(const std::vector<SignedPart>& parts, double& swept);
  std::optional<double> lost_past(const std::vector<HullBlocker>& one, double reach) const;
  double reach_with(std::span<const std::vector<Vec3>> blockers) const;

  const ExactPlane &from_, &to_;
  std::vector<Part> sources_, receivers_;
  double swept_ = 0;  ///< bounds what rounding the corners of the two moves
};

}  // namespace etendue
