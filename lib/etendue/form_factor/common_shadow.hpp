// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "etendue/form_factor/certified_parts.hpp"
#include "etendue/form_factor/certified_shadows.hpp"
#include "etendue/form_factor/shadow_term.hpp"

namespace etendue {

struct EnclosedBlocker {
  std::vector<Vec3> vertices;
  ExactPlane plane;
};

/// Encloses the flux from one triangle of the source, which starts at `corner`, to one convex part of the receiver that
/// every one of `blockers` keeps away.
///
/// Returns   the enclosure, at least 0; half its width is about `goal` unless `budget` was spent before
/// Accuracy  inclusion proved: NOTES.md §11
/// Errors    none
[[nodiscard]] HiddenFlux common_shadow(const Interval3& corner, const SourceTriangle& source,
                                       const SignedPart& receiver, const std::vector<const EnclosedBlocker*>& blockers,
                                       double goal, std::int64_t budget);

}  // namespace etendue
