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

/// How often the line crosses the torus at t > 0: roots of odd order, counted by Sturm's sequence.
long torus_crossings(const Point& origin, const Point& direction, const Point& centre, const Point& axis, double ring,
                     double tube);

/// Both nappes of |A|⁴ |x|² − |A|² (A·x)² = (R₀ |A|² + (R₁ − R₀) A·x)², x from the base, A = top − base.
LineRoots cone_roots(const Point& origin, const Point& direction, const Point& base, const Point& top,
                     double base_radius, double top_radius);

/// x·Q x + 2 q·x + k = 0, x from the centre; Q's rows as given, not made symmetric.
LineRoots quadric_roots(const Point& origin, const Point& direction, const Point& centre,
                        const std::array<Point, 3>& square, const Point& linear, double constant);

/// How often the line crosses the quadric at t > 0: roots of odd order, counted by Sturm's sequence.
long quadric_crossings(const Point& origin, const Point& direction, const Point& centre,
                       const std::array<Point, 3>& square, const Point& linear, double constant);

/// Where the line meets a bicubic Bézier surface: all common zeros (u, v) of the two
/// polynomials that say how far the surface's point is from two planes through the line, by resultants.
struct SurfaceCrossing {
  Wide t;
  double u = 0, v = 0;
};
/// Domain    coordinates are integers below 2^30; 0 ≤ u, v ≤ 1; ascending t
std::vector<SurfaceCrossing> bezier_crossings(const Point& origin, const Point& direction,
                                              const std::array<std::array<Point, 4>, 4>& control);

}  // namespace etendue::oracle
