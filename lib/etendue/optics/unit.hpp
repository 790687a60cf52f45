// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// How far |v|² of a "unit vector" may lie from 1. Wide enough for a normalised vector (7 u, NOTES.md §1) that went
/// through a thousand rotations or reflections without being normalised again (8 u each); narrow enough to catch one
/// that was normalised in single precision (2^-24) or not at all. The bounds of reflect() and refract() do not
/// contain it.
inline constexpr double kUnitTolerance = 0x1p-40;

/// Whether `v` may be passed where a unit vector is demanded; false for NaN.
inline bool is_unit(const Vec3& v) {
  return std::abs(v.squaredNorm() - 1) <= kUnitTolerance;
}

}  // namespace etendue
