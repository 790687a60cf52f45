// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "oracles/exact_intersections.hpp"

// Where a line crosses algebraic surfaces, by exact polynomials: FLINT's rational polynomials, Sturm's sequences for the
// number of roots, Arb's isolated roots for their places. Doubles in; what is given is taken to be exact.
namespace etendue::oracle {

/// Parameters at which f changes its sign along the line, ascending, to 106 bits: real roots of odd order.
/// The number of distinct real roots of any order is `distinct`, counted by Sturm's sequence.
struct LineRoots {
  std::vector<Wide> changes;
  long distinct = 0;
};

/// (|x|² + R² − r²)² |A|² = 4R² (|x|² |A|² − (A·x)²), x from the centre.
LineRoots torus_roots(const Point& origin, const Point& direction, const Point& centre, const Point& axis, double ring,
                      double tube);

/// Both nappes of |A|⁴ |x|² − |A|² (A·x)² = (R₀ |A|² + (R₁ − R₀) A·x)², x from the base, A = top − base.
LineRoots cone_roots(const Point& origin, const Point& direction, const Point& base, const Point& top,
                     double base_radius, double top_radius);

/// x·Q x + 2 q·x + k = 0, x from the centre; Q's rows as given, not made symmetric.
LineRoots quadric_roots(const Point& origin, const Point& direction, const Point& centre,
                        const std::array<Point, 3>& square, const Point& linear, double constant);

}  // namespace etendue::oracle
