// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

// Intersections by exact rational arithmetic (CGAL's kernels over GMP), and their irrational roots by MPFR at 1000
// bits. Doubles in, doubles out: what is given is taken to be exact.
namespace etendue::oracle {

using Point = std::array<double, 3>;
using Flat = std::array<double, 2>;

/// A real number to 106 bits: high + low.
struct Wide {
  double high = 0, low = 0;
};

/// Side of the plane through `on` with this normal: 1 in front, −1 behind, 0 on it.
int side_of_plane(const Point& point, const Point& on, const Point& normal);

/// 1 where c lies to the left of the line a → b, −1 right, 0 on it.
int turn(const Flat& a, const Flat& b, const Flat& c);

/// Inside a simple polygon 1, on its boundary 0, outside −1.
int side_of_polygon(const Flat& point, const std::vector<Flat>& polygon);

bool is_simple(const std::vector<Flat>& polygon);

/// Does the closed half-line from `origin` meet the closed triangle? A triangle without area is never met.
bool ray_meets_triangle(const Point& origin, const Point& direction, const std::array<Point, 3>& triangle);

/// Signs of the three edges' volumes D·((p−O)×(q−O)) for the edges bc, ca, ab.
std::array<int, 3> edge_signs(const Point& origin, const Point& direction, const std::array<Point, 3>& triangle);

/// Sign of the volume (a − point)·((b − a)×(c − a)): 0 where the point lies in the triangle's plane.
int volume_sign(const Point& point, const std::array<Point, 3>& triangle);

/// Least distance between the ray's line and the three lines through the edges.
double distance_to_edges(const Point& origin, const Point& direction, const std::array<Point, 3>& triangle);

/// Parameter at which the line meets a plane; none where it is parallel.
std::optional<Wide> plane_parameter(const Point& origin, const Point& direction, const Point& on, const Point& normal);
std::optional<Wide> plane_parameter(const Point& origin, const Point& direction, const std::array<Point, 3>& corners);

/// A line against a quadric: signs are exact, roots are rounded at the end.
struct Roots {
  int discriminant = 0;  ///< sign; the roots below are set where it is positive
  int origin_side = 0;   ///< of the ray's origin: 1 outside, 0 on the surface, −1 inside
  Wide near, far;
};
Roots sphere_roots(const Point& origin, const Point& direction, const Point& centre, double radius);
/// The infinite cylinder around the line through base and top.
Roots cylinder_roots(const Point& origin, const Point& direction, const Point& base, const Point& top, double radius);

/// Parameters of the part of the line inside a closed box with these three axes (columns); none where it misses.
struct Interval {
  Wide first, last;
};
std::optional<Interval> box_interval(const Point& origin, const Point& direction, const Point& centre,
                                     const std::array<Point, 3>& axes, const Point& half_edges);

/// |point − (origin + t direction)|
double distance_along(const Point& point, const Point& origin, const Point& direction, const Wide& t);

/// Distance of a point from a plane, from a sphere.
double distance_to_plane(const Point& point, const Point& on, const Point& normal);
double distance_to_sphere(const Point& point, const Point& centre, double radius);

/// Error of `computed` in units in the last place of the exact number.
double ulps(double computed, const Wide& exact);

}  // namespace etendue::oracle
