// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// An edge of a loop: with a point of the source it spans a plane.
struct ViewEdge {
  Vec3 start, along;
};

/// A corner in the view from the source: where an edge starts, or where two cross as seen.
struct ViewCorner {
  std::uint32_t first, second;  ///< edges: the same twice for its start; else the corner lies along first × second, the
                                ///< normals of their planes
  bool closes = false;          ///< repeats the first corner of its loop
};

/// Loops one after the other, clockwise as seen, each closed by its first corner: what of a receiver is seen, or hidden,
/// named by what bounds it. Between critical lines that is the same from all points: nothing has to be cut again.
using ViewForm = std::vector<ViewCorner>;

/// Lambert's sums of the loops for points of the source's plane, added to `factors`: factors of what they enclose, for a
/// surface across z.
///
/// Domain    points from which no two edges that cross in the form are one
/// Accuracy  a few u for each arc between two corners; where two edges cross at a small angle the corner slides along
///           both, which is no more
/// Order     a point's bits do not depend on the others, nor on the instruction set
void add_factors(std::span<const ViewEdge> edges, std::span<const ViewCorner> form, std::span<const Vec2> points,
                 std::span<double> factors);

/// Whether, seen from all points, edges that cross do so on the same side as seen from `centre`.
[[nodiscard]] bool keeps_sides(std::span<const ViewEdge> edges, std::span<const ViewCorner> form, const Vec2& centre,
                               std::span<const Vec2> points);

/// Arc length over tangent, atan(√q)/√q, for 0 ≤ q ≤ kShortArc: what Taylor's series leaves out, q⁹/19, is below 2^-58.
inline constexpr double kShortArc = 1.0 / 64;
template <class Number>  // double, or several side by side
[[gnu::always_inline]] inline void arc_over_tangent(const Number& q, Number& result) {
  result = 1.0 / 17 + Number{};
  for (int k = 15; k > 0; k -= 2) result = 1.0 / k - q * result;
}

}  // namespace etendue
