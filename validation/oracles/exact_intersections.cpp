// SPDX-License-Identifier: Apache-2.0
#include "oracles/exact_intersections.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace etendue::oracle {

namespace {

using Number = CGAL::Gmpq;
using Kernel = CGAL::Simple_cartesian<Number>;
using Vector = Kernel::Vector_3;

Kernel::Point_3 point3(const Point& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2])};
}
Vector vector3(const Point& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2])};
}
Kernel::Point_2 point2(const Flat& p) {
  return {Number(p[0]), Number(p[1])};
}

std::vector<Kernel::Point_2> points2(const std::vector<Flat>& flat) {
  std::vector<Kernel::Point_2> points;
  for (const Flat& p : flat) points.push_back(point2(p));
  return points;
}

constexpr mpfr_prec_t kBits = 1000;

// A real number of 1000 bits.
class Real {
 public:
  Real() { mpfr_init2(value_, kBits); }
  explicit Real(const Number& q) : Real() { mpfr_set_q(value_, q.mpq(), MPFR_RNDN); }
  Real(const Real& other) : Real() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Real& operator=(const Real& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Real() { mpfr_clear(value_); }

  friend Real operator+(const Real& a, const Real& b) { return make(mpfr_add, a, b); }
  friend Real operator-(const Real& a, const Real& b) { return make(mpfr_sub, a, b); }
  friend Real operator/(const Real& a, const Real& b) { return make(mpfr_div, a, b); }
  Real root() const {
    Real r;
    mpfr_sqrt(r.value_, value_, MPFR_RNDN);
    return r;
  }
  Wide wide() const {
    Wide w;
    w.high = mpfr_get_d(value_, MPFR_RNDN);
    Real rest;
    mpfr_sub_d(rest.value_, value_, w.high, MPFR_RNDN);
    w.low = mpfr_get_d(rest.value_, MPFR_RNDN);
    return w;
  }

 private:
  template <class Operation>
  static Real make(Operation operation, const Real& a, const Real& b) {
    Real r;
    operation(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }
  mpfr_t value_;
};

Wide wide(const Number& q) {
  return Real(q).wide();
}

double root(const Number& q) {
  return Real(q).root().wide().high;
}

int sign(const Number& q) {
  return static_cast<int>(CGAL::sign(q));
}

// Roots of a t² + 2bt + c. 1000 bits leave more than 500 after any cancellation that doubles can cause here.
Roots roots(const Number& a, const Number& b, const Number& c) {
  Roots result;
  const Number discriminant = b * b - a * c;
  result.discriminant = sign(discriminant);
  result.origin_side = sign(c);
  if (result.discriminant <= 0) return result;
  const Real s = Real(discriminant).root(), minus_b = Real(-b), by = Real(a);
  result.near = ((minus_b - s) / by).wide();
  result.far = ((minus_b + s) / by).wide();
  if (result.origin_side == 0) (sign(b) < 0 ? result.near : result.far) = {};
  return result;
}

std::optional<Wide> quotient(const Number& above, const Number& below) {
  if (sign(below) == 0) return std::nullopt;
  return wide(Number(above / below));
}

std::array<Vector, 3> relative(const std::array<Point, 3>& triangle, const Point& origin) {
  return {point3(triangle[0]) - point3(origin), point3(triangle[1]) - point3(origin),
          point3(triangle[2]) - point3(origin)};
}

}  // namespace

int side_of_plane(const Point& point, const Point& on, const Point& normal) {
  const Kernel::Plane_3 plane(point3(on), vector3(normal));
  return static_cast<int>(plane.oriented_side(point3(point)));
}

int turn(const Flat& a, const Flat& b, const Flat& c) {
  return static_cast<int>(CGAL::orientation(point2(a), point2(b), point2(c)));
}

int side_of_polygon(const Flat& point, const std::vector<Flat>& polygon) {
  const auto points = points2(polygon);
  return static_cast<int>(CGAL::bounded_side_2(points.begin(), points.end(), point2(point), Kernel()));
}

bool is_simple(const std::vector<Flat>& polygon) {
  const auto points = points2(polygon);
  return CGAL::is_simple_2(points.begin(), points.end(), Kernel());
}

int volume_sign(const Point& point, const std::array<Point, 3>& triangle) {
  const auto p = relative(triangle, point);
  return sign(CGAL::cross_product(p[1] - p[0], p[2] - p[0]) * p[0]);
}

bool ray_meets_triangle(const Point& origin, const Point& direction, const std::array<Point, 3>& triangle) {
  const Kernel::Ray_3 ray(point3(origin), vector3(direction));
  const Kernel::Triangle_3 corners(point3(triangle[0]), point3(triangle[1]), point3(triangle[2]));
  return !corners.is_degenerate() && CGAL::do_intersect(ray, corners);
}

std::array<int, 3> edge_signs(const Point& origin, const Point& direction, const std::array<Point, 3>& triangle) {
  const auto p = relative(triangle, origin);
  const Vector d = vector3(direction);
  const auto volume = [&](const Vector& from, const Vector& to) { return sign(d * CGAL::cross_product(from, to)); };
  return {volume(p[1], p[2]), volume(p[2], p[0]), volume(p[0], p[1])};
}

double distance_to_edges(const Point& origin, const Point& direction, const std::array<Point, 3>& triangle) {
  const auto p = relative(triangle, origin);
  const Vector d = vector3(direction);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector &from = p[i], &to = p[(i + 1) % 3];
    const Number volume = d * CGAL::cross_product(from, to);
    const Number square = CGAL::cross_product(d, to - from).squared_length();
    if (sign(square) != 0) least = std::min(least, root(Number(volume * volume / square)));
  }
  return least;
}

std::optional<Wide> plane_parameter(const Point& origin, const Point& direction, const Point& on, const Point& normal) {
  const Vector n = vector3(normal);
  return quotient(n * (point3(on) - point3(origin)), n * vector3(direction));
}

std::optional<Wide> plane_parameter(const Point& origin, const Point& direction, const std::array<Point, 3>& corners) {
  const auto p = relative(corners, origin);
  const Vector n = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
  return quotient(n * p[0], n * vector3(direction));
}

Roots sphere_roots(const Point& origin, const Point& direction, const Point& centre, double radius) {
  const Vector v = point3(origin) - point3(centre), d = vector3(direction);
  const Number r = radius;
  return roots(d * d, d * v, v * v - r * r);
}

Roots cylinder_roots(const Point& origin, const Point& direction, const Point& base, const Point& top, double radius) {
  const Vector axis = point3(top) - point3(base), v = point3(origin) - point3(base);
  const Vector m = CGAL::cross_product(v, axis), n = CGAL::cross_product(vector3(direction), axis);
  const Number r = radius;
  return roots(n * n, m * n, m * m - r * r * (axis * axis));
}

std::optional<Interval> box_interval(const Point& origin, const Point& direction, const Point& centre,
                                     const std::array<Point, 3>& axes, const Point& half_edges) {
  const Vector v = point3(origin) - point3(centre), d = vector3(direction);
  std::optional<Number> first, last;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector axis = vector3(axes[i]);
    const Number half = half_edges[i], height = axis * v, speed = axis * d;
    if (sign(speed) == 0) {
      if (CGAL::abs(height) > half) return std::nullopt;
      continue;
    }
    const Number one = (-half - height) / speed, two = (half - height) / speed;
    const Number low = std::min(one, two), high = std::max(one, two);
    first = first ? std::max(*first, low) : low;
    last = last ? std::min(*last, high) : high;
  }
  if (!first || *first > *last) return std::nullopt;
  return Interval{wide(*first), wide(*last)};
}

double distance_along(const Point& point, const Point& origin, const Point& direction, const Wide& t) {
  const Number parameter = Number(t.high) + Number(t.low);
  const Vector gap = point3(origin) + parameter * vector3(direction) - point3(point);
  return root(gap.squared_length());
}

double distance_to_plane(const Point& point, const Point& on, const Point& normal) {
  const Vector n = vector3(normal);
  const Number height = n * (point3(point) - point3(on));
  return root(Number(height * height / n.squared_length()));
}

double distance_to_sphere(const Point& point, const Point& centre, double radius) {
  const Number square = (point3(point) - point3(centre)).squared_length();
  return std::abs((Real(square).root() - Real(Number(radius))).wide().high);
}

double ulps(double computed, const Wide& exact) {
  int exponent = 0;
  std::frexp(exact.high, &exponent);
  return std::abs((computed - exact.high) - exact.low) / std::ldexp(1.0, exponent - 53);
}

}  // namespace etendue::oracle
