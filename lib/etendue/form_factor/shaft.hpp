// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/form_factor/facing_pair.hpp"

namespace etendue {

/// What a set of blockers can do to a pair.
struct Shaft {
  std::vector<std::vector<Vec3>> blockers;  ///< what is left of those that may hide something, in from's coordinates
  bool hides_all = false;                   ///< one of them certainly crosses every line from `from` to `to`
};

/// Keeps of each blocker the part strictly between the planes of the pair, and drops those that a plane separates from
/// the convex hull of `from` and `to`. Dropping and `hides_all` are decided with a margin for rounding.
///
/// Domain    blockers convex; `from_origin` is the point around which the pair was localised
[[nodiscard]] Shaft shaft(const FacingPair& pair, const Vec3& from_origin, std::span<const Polygon> blockers);

}  // namespace etendue
