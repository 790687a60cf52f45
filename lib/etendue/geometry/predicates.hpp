// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/plane.hpp"
#include "etendue/geometry/vector.hpp"

namespace etendue {

/// On which side of the line from `a` to `b` the point `c` lies: 1 left, −1 right, 0 on the line.
///
/// Accuracy  exact, proved: a filter in double, then expansions (NOTES.md §2)
/// Domain    coordinate differences between 2^-200 and 2^200, or zero
/// Source    Shewchuk 1997
[[nodiscard]] int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Do the closed segments from `p` to `q` and from `r` to `s` have a point in common?
///
/// Accuracy  exact, proved: every decision is an orientation()
/// Domain    as for orientation(); no segment is a point
[[nodiscard]] bool segments_meet(const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& s);

/// ab − cd without cancellation.
///
/// Accuracy  relative error at most 2 u where the rounded products are equal, 3 u otherwise; the sign is exact. Proved
/// Domain    products and their rounding errors do not underflow: |ab|, |cd| ≥ 2^-960 or zero
/// Source    Jeannerod, Louvet and Muller 2013 (Kahan's algorithm)
[[nodiscard]] double difference_of_products(double a, double b, double c, double d);

/// On which side of the plane `point` lies: 1 in front (where the normal points), −1 behind, 0 on it.
/// The plane is the one its stored doubles describe.                                                @eq IU.5-12
///
/// Accuracy  exact, proved: a filter in double, then expansions (NOTES.md §2)
/// Domain    as for orientation()
[[nodiscard]] int side(const Vec3& point, const Plane& plane);

}  // namespace etendue
