// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/exact_decision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/interval.hpp"
#include "etendue/geometry/integer.hpp"

namespace etendue {

namespace {

template <class Number>
using Triple = std::array<Number, 3>;

template <class Number>
Triple<Number> operator-(const Triple<Number>& a, const Triple<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
Number dot(const Triple<Number>& a, const Triple<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
Triple<Number> cross(const Triple<Number>& a, const Triple<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Signs, and whether all that were asked for are certain.
struct Signs {
  bool certain = true;

  int of(const Interval& x) {
    if (x.certainly_positive()) return 1;
    if (x.certainly_negative()) return -1;
    certain = certain && x.is_zero();
    return 0;
  }
  int of(const Integer& x) { return x.sign(); }
};

// What a decision is made from: `points` count from the ray's origin. Directions, lengths and t may each be scaled.
template <class Number>
struct View {
  Triple<Number> direction;
  std::vector<Triple<Number>> points;
  std::vector<Number> lengths;  // radii
  std::vector<Triple<Number>> normals;
  Number low;                  // max(0, t_min)
  std::optional<Number> high;  // t_max where that is finite
};

// What is decided about, in doubles.
struct Subject {
  std::vector<Vec3> points = {};
  std::vector<double> lengths = {};
  std::vector<Vec3> normals = {};
};

View<Interval> in_intervals(const Ray& ray, const Subject& subject) {
  const auto triple = [](const Vec3& v) { return Triple<Interval>{v.x(), v.y(), v.z()}; };
  View<Interval> view{triple(ray.direction), {}, {}, {}, std::max(0.0, ray.t_min), std::nullopt};
  for (const Vec3& p : subject.points) view.points.push_back(triple(p) - triple(ray.origin));
  for (const double length : subject.lengths) view.lengths.emplace_back(length);
  for (const Vec3& n : subject.normals) view.normals.push_back(triple(n));
  if (std::isfinite(ray.t_max)) view.high = ray.t_max;
  return view;
}

int least_exponent(std::span<const double> values) {
  std::optional<int> least;
  for (const double value : values) {
    if (value != 0) least = std::min(least.value_or(Integer::exponent_of(value)), Integer::exponent_of(value));
  }
  return least.value_or(0);
}
int least_exponent(const Vec3& v) {
  return least_exponent(std::span(v.data(), 3));
}

// Direction / 2^p, lengths / 2^q and t / 2^(q − p): t D keeps the scale of a length.
View<Integer> in_integers(const Ray& ray, const Subject& subject) {
  const auto triple = [](const Vec3& v, int exponent) {
    return Triple<Integer>{Integer::scaled(v.x(), exponent), Integer::scaled(v.y(), exponent),
                           Integer::scaled(v.z(), exponent)};
  };
  const double low = std::max(0.0, ray.t_min), high = std::isfinite(ray.t_max) ? ray.t_max : 0;
  const int p = least_exponent(ray.direction);
  int q = std::min(least_exponent(ray.origin), least_exponent(std::array{low, high}) + p);
  for (const Vec3& point : subject.points) q = std::min(q, least_exponent(point));
  q = std::min(q, least_exponent(subject.lengths));

  View<Integer> view{triple(ray.direction, p), {}, {}, {}, Integer::scaled(low, q - p), std::nullopt};
  for (const Vec3& point : subject.points) view.points.push_back(triple(point, q) - triple(ray.origin, q));
  for (const double length : subject.lengths) view.lengths.push_back(Integer::scaled(length, q));
  for (const Vec3& n : subject.normals) view.normals.push_back(triple(n, least_exponent(n)));
  if (std::isfinite(ray.t_max)) view.high = Integer::scaled(ray.t_max, q - p);
  return view;
}

// Whether t = above / below, below ≠ 0, lies in the range.
template <class Number>
bool in_range(const View<Number>& view, const Number& above, const Number& below, Signs& signs) {
  const int side = signs.of(below);
  if (signs.of(above - view.low * below) * side <= 0) return false;
  return !view.high || signs.of(*view.high * below - above) * side > 0;
}

// a t² − 2 b t + c with b = D·C, c = C² − R²: a root between the ends of the range.
template <class Number>
bool meets_sphere(const View<Number>& view, Signs& signs) {
  const Triple<Number>& d = view.direction;
  const Triple<Number>& centre = view.points[0];
  const Number a = dot(d, d), b = dot(d, centre), c = dot(centre, centre) - view.lengths[0] * view.lengths[0];
  if (signs.of(b * b - a * c) <= 0) return false;
  // Of a number t: the polynomial's sign there, and on which side of the vertex b/a it lies.
  const auto value = [&](const Number& t) { return signs.of((a * t - b - b) * t + c); };
  const auto beyond = [&](const Number& t) { return signs.of(a * t - b); };
  const int low = value(view.low), low_beyond = beyond(view.low);
  const bool first_after = low > 0 && low_beyond < 0, second_after = low < 0 || low_beyond < 0;
  if (!view.high) return second_after;
  const int high = value(*view.high), high_beyond = beyond(*view.high);
  const bool first_before = high < 0 || high_beyond > 0, second_before = high > 0 && high_beyond > 0;
  return (first_after && first_before) || (second_after && second_before);
}

// points[0] on the plane.
template <class Number>
bool meets_plane(const View<Number>& view, Signs& signs) {
  const Number below = dot(view.normals[0], view.direction);
  return signs.of(below) != 0 && in_range(view, dot(view.normals[0], view.points[0]), below, signs);
}

template <class Number>
bool meets_triangle(const View<Number>& view, Signs& signs) {
  const auto& [a, b, c] = std::tie(view.points[0], view.points[1], view.points[2]);
  const Triple<Number> normal = cross(b - a, c - a);
  const Number below = dot(normal, view.direction);
  const int facing = signs.of(below);
  if (facing == 0) return false;  // as it is where there is no area
  for (const auto& [p, q] : {std::pair(&a, &b), std::pair(&b, &c), std::pair(&c, &a)}) {
    if (signs.of(dot(view.direction, cross(*p, *q))) * facing < 0) return false;
  }
  return in_range(view, dot(normal, a), below, signs);
}

// The corners but the last one, which lies on the plane.
template <class Number>
bool meets_polygon(const View<Number>& view, std::size_t z, Signs& signs) {
  const std::size_t x = (z + 1) % 3, y = (z + 2) % 3, n = view.points.size() - 1;
  const Triple<Number>& d = view.direction;
  const int forward = signs.of(d[z]);
  // D_z times what the shear makes of a corner: the line becomes the origin.
  const auto across = [&](const Triple<Number>& p, std::size_t i) { return p[i] * d[z] - d[i] * p[z]; };
  bool inside = false;
  for (std::size_t i = 0; i < n; ++i) {
    const Triple<Number>&p = view.points[(i + n - 1) % n], &q = view.points[i];
    const Number p_up = across(p, y), q_up = across(q, y);
    const bool q_above = signs.of(q_up) * forward >= 0;
    if ((signs.of(p_up) * forward >= 0) == q_above) continue;
    const int turn = signs.of(across(p, x) * q_up - p_up * across(q, x));
    if (q_above ? turn > 0 : turn < 0) inside = !inside;
  }
  if (!inside) return false;
  const Number below = dot(view.normals[0], d);
  return signs.of(below) != 0 && in_range(view, dot(view.normals[0], view.points.back()), below, signs);
}

// First in doubles rounded outward; where a sign is not certain, in whole numbers.
template <class Test>
Decision decide(const Ray& ray, const Subject& subject, const Test& test) {
  require(ray.origin.allFinite() && ray.direction.allFinite() && !ray.direction.isZero(0),
          "decide_exactly: the ray is finite, its direction not zero");
  for (const Vec3& p : subject.points) require(p.allFinite(), "decide_exactly: points are finite");
  for (const Vec3& n : subject.normals) require(n.allFinite(), "decide_exactly: normals are finite");
  if (!(std::max(0.0, ray.t_min) < ray.t_max)) return {};
  Signs signs;
  const bool hit = test(in_intervals(ray, subject), signs);
  if (signs.certain) return {hit, Tier::intervals};
  return {test(in_integers(ray, subject), signs), Tier::integers};
}

}  // namespace

Decision decide_exactly(const Ray& ray, const Sphere& sphere) {
  require(sphere.radius > 0 && std::isfinite(sphere.radius), "decide_exactly: the radius is positive");
  return decide(ray, {{sphere.centre}, {sphere.radius}, {}},
                [](const auto& view, Signs& signs) { return meets_sphere(view, signs); });
}

Decision decide_exactly(const Ray& ray, const Plane& plane) {
  return decide(ray, {{plane.point}, {}, {plane.normal}},
                [](const auto& view, Signs& signs) { return meets_plane(view, signs); });
}

Decision decide_exactly(const Ray& ray, const Triangle& triangle) {
  return decide(ray, {{triangle.a, triangle.b, triangle.c}, {}, {}},
                [](const auto& view, Signs& signs) { return meets_triangle(view, signs); });
}

Decision decide_exactly(const Ray& ray, const Polygon& polygon) {
  Subject subject{polygon.vertices(), {}, {polygon.normal()}};
  subject.points.push_back(polygon.centroid());
  Eigen::Index z = 0;
  ray.direction.cwiseAbs().maxCoeff(&z);
  return decide(ray, subject, [z](const auto& view, Signs& signs) {
    return meets_polygon(view, static_cast<std::size_t>(z), signs);
  });
}

}  // namespace etendue
