// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/form_factor/certified.hpp"
#include "etendue/form_factor/certified_outline.hpp"

namespace etendue {

/// Encloses the factor through two outlines that face one another, whatever lies between: by the contour where they are
/// near, by the area rule where they are far, by both where one does not reach the goal.                  @eq IU.6-3
///
/// Domain    outlines of size order one, each in front of the other's plane, in chains whose flux is not negative
/// Returns   the enclosure within [0, 1], what it took, and whether the goal was met
/// Accuracy  inclusion proved: NOTES.md §10
[[nodiscard]] CertifiedFactor enclosed_factor(const EnclosedPair& pair, const CertifiedGoal& goal);

}  // namespace etendue
