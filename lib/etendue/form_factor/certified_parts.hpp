// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/form_factor/certified_outline.hpp"

namespace etendue {

/// A convex part of an outline, with the sign that its triangle has in the fan of a concave one.
struct SignedPart {
  EnclosedOutline outline;
  double sign = 1;
  double uncertain = 0;  ///< bounds its area where the sign is not certain
};

/// A convex outline whole, any other as the signed triangles of a fan.
[[nodiscard]] std::vector<SignedPart> signed_parts(const EnclosedOutline& outline);

/// The signed triangles of a fan, whatever the outline: each turns as the outline does.
[[nodiscard]] std::vector<SignedPart> signed_triangles(const EnclosedOutline& outline);

/// Twice the vector area.
[[nodiscard]] Interval3 doubled_area_of(const EnclosedOutline& outline);

}  // namespace etendue
