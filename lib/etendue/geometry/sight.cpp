// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/sight.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/polygon_meeting.hpp"

namespace etendue {

namespace {

using Kind = Sight::Kind;

// What quadratic forms lose here, as a share of the product of the lengths in them, and sums of three products with a
// summand, as a share of their magnitudes: 23 u and 5 u are proved. NOTES.md §13.
constexpr double kLoss = 32 * kUnitRoundoff, kSumLoss = gamma_bound(6);

// A parameter of the ray and a bound on its error.
struct Parameter {
  double t, error;
};

// Whether the ray looks at it: miss is no.
Kind looks(const Ray& ray, const Parameter& at) {
  const double low = at.t - at.error, high = at.t + at.error, start = std::max(0.0, ray.t_min);
  if (low > start && high < ray.t_max) return Kind::hit;
  return high < start || low > ray.t_max ? Kind::miss : Kind::unsure;
}

Sight seen(Kind kind, const Parameter& at) {
  return {kind, at.t - at.error, at.t + at.error};
}

// The first of two parameters that counts; `counts` says so of each.
template <class Counts>
Sight first_of(const Parameter& near, const Parameter& far, Counts counts) {
  for (const Parameter& each : {near, far}) {
    const Kind kind = counts(each);
    if (kind != Kind::miss) return seen(kind, each);
  }
  return Sight::missed();
}

// A sum of three products, and the sum of their magnitudes.
struct Sum {
  double value, magnitude;
};
Sum sum_of_products(const Vec3& a, const Vec3& b) {
  const double x = a.x() * b.x(), y = a.y() * b.y(), z = a.z() * b.z();
  return {x + y + z, std::abs(x) + std::abs(y) + std::abs(z)};
}

// The speed at which the ray rises over a plane.
struct Speed {
  double value, inverse, error;

  explicit Speed(const Sum& sum) : value(sum.value), inverse(1 / sum.value), error(kSumLoss * sum.magnitude) {}

  // Where the ray comes to the height over its origin that `height` says; error infinite where it may not.
  Parameter arrival(double height, double height_error) const {
    if (!(std::abs(value) > 16 * error)) return {0, std::numeric_limits<double>::infinity()};
    const double t = height * inverse;
    return {t, 1.125 * (height_error + std::abs(t) * error) * std::abs(inverse) + kLoss * std::abs(t)};
  }
};

Parameter arrival_at_plane(const Ray& ray, const Vec3& normal, const Vec3& point) {
  const Sum height = sum_of_products(normal, point - ray.origin);
  return Speed(sum_of_products(normal, ray.direction)).arrival(height.value, kSumLoss * height.magnitude);
}

// How far a point of the ray, or the one that intersect() makes of it, may be from where the ray truly is there.
double place_error(const Ray& ray, const Parameter& at) {
  return kLoss * (ray.origin.lpNorm<1>() + std::abs(at.t) * ray.direction.lpNorm<1>()) +
         at.error * ray.direction.lpNorm<1>();
}

}  // namespace

Sight sight(const Ray& ray, const Sphere& sphere) {
  const Vec3 v = ray.origin - sphere.centre;
  const double a = ray.direction.squaredNorm(), b = ray.direction.dot(v), lambda = v.squaredNorm();
  const double square = sphere.radius * sphere.radius;
  const double discriminant = a * square - v.cross(ray.direction).squaredNorm();
  const double error = kLoss * a * (square + lambda);
  if (discriminant < -error) return Sight::missed();
  // From outside, and not coming nearer: so do rays that leave the sphere.
  if (lambda - square > kSumLoss * (lambda + square) && b > kSumLoss * ray.direction.cwiseProduct(v).lpNorm<1>())
    return Sight::missed();
  if (!(discriminant > error)) return {};
  const double root = std::sqrt(discriminant), size = std::sqrt(a * lambda);
  const double inverse = 1 / a, t_error = 2 * (kLoss * (size + root) + error / root) * inverse;
  return first_of({-(b + root) * inverse, t_error}, {(root - b) * inverse, t_error},
                  [&](const Parameter& each) { return looks(ray, each); });
}

Sight sight(const Ray& ray, const Cylinder& cylinder) {
  const Vec3 v = ray.origin - cylinder.base, axis = cylinder.top - cylinder.base, &d = ray.direction;
  const Vec3 n = d.cross(axis);
  const double volume = n.dot(v), a = n.squaredNorm(), radius = cylinder.radius;  // A·(v × D) = v·(D × A)
  const double d_square = d.squaredNorm(), v_square = v.squaredNorm(), a_square = axis.squaredNorm();
  const double discriminant = a * radius * radius - volume * volume;
  const double error = kLoss * a_square * d_square * (radius * radius + v_square);
  if (discriminant < -error) return Sight::missed();
  const Vec3 m = v.cross(axis);
  const double b = m.dot(n), m_square = m.squaredNorm(), wall = radius * radius * a_square;
  // From outside, and not coming nearer: so do rays that leave the wall.
  const double sizes_square = v_square * a_square;
  if (m_square - wall > 2 * kSumLoss * (std::sqrt(sizes_square * m_square) + m_square + wall) &&
      b > 2 * kSumLoss * (std::sqrt(m_square * d_square * a_square) + std::sqrt(a * sizes_square)))
    return Sight::missed();
  const double square_error = kLoss * d_square * a_square;
  if (!(discriminant > error && a > 4 * square_error)) return {};
  const double length = std::sqrt(a_square), root = length * std::sqrt(discriminant);
  const double sizes = a_square * std::sqrt(v_square * d_square);
  const double root_error = kLoss * (2 * sizes + root) + a_square * error / root;
  const double start = v.dot(axis), speed = d.dot(axis);
  const double v_size = std::sqrt(v_square) * length, d_size = std::sqrt(d_square) * length;
  const double inverse = 1 / a;
  const auto at = [&](double sum) {
    const double t = sum * inverse;
    return Parameter{t, 2 * (root_error + std::abs(t) * square_error) * inverse};
  };
  return first_of(at(-b - root), at(root - b), [&](const Parameter& each) {
    const Kind kind = looks(ray, each);
    if (kind == Kind::miss) return kind;
    const double height = start + each.t * speed;  // 0 at the base, |A|² at the top
    const double room = kLoss * (v_size + std::abs(each.t) * d_size + a_square) + 2 * each.error * d_size;
    if (height < -room || height > a_square + room) return Kind::miss;
    return height > room && height < a_square - room ? kind : Kind::unsure;
  });
}

Sight sight(const Ray& ray, const Plane& plane) {
  const Parameter at = arrival_at_plane(ray, plane.normal, plane.point);
  return seen(looks(ray, at), at);
}

Sight sight(const Ray& ray, const Disc& disc) {
  const Parameter at = arrival_at_plane(ray, disc.normal, disc.centre);
  const Kind kind = looks(ray, at);
  if (kind == Kind::miss || !(at.error < std::numeric_limits<double>::infinity())) return seen(kind, at);
  const Vec3 offset = ray.at(at.t) - disc.centre;
  const double out = offset.norm();
  const double room = place_error(ray, at) + kLoss * (disc.centre.lpNorm<1>() + disc.radius);
  if (out > disc.radius + room) return Sight::missed();
  return seen(out < disc.radius - room ? kind : Kind::unsure, at);
}

Sight sight(const Ray& ray, const Polygon& polygon) {
  if (!passes_through(shear_of(ray.direction), ray.origin, polygon.vertices())) return Sight::missed();
  const Parameter at = arrival_at_plane(ray, polygon.normal(), polygon.centroid());
  Vec3 low = polygon.vertices()[0], high = low;
  for (const Vec3& vertex : polygon.vertices()) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  // Where the place may lie beside this box, widened by less than intersect() does, it may take another t.
  const double room = kPlanarity / 4 * (high - low).maxCoeff();
  const Vec3 place = ray.at(at.t);
  const bool kept = (place.array() > low.array() - room).all() && (place.array() < high.array() + room).all() &&
                    place_error(ray, at) < room;
  return kept ? seen(looks(ray, at), at) : Sight{};
}

BoxSight box_sight(const Ray& ray, const Box& box) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Vec3 v = ray.origin - box.centre;
  // Where it enters and leaves: the largest of three bounds, the least of three.
  double enter_low = -kNever, enter_high = -kNever, leave_low = kNever, leave_high = kNever;
  int enter_axis = -1, leave_axis = -1;  // of the face, if it is certain
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 normal = box.axes.col(axis);
    const double half = box.half_edges[axis];
    const Sum height = sum_of_products(normal, v);
    const Speed speed(sum_of_products(normal, ray.direction));
    const double error = kSumLoss * (height.magnitude + half), towards = speed.value > 0 ? -half : half;
    const Parameter first = speed.arrival(towards - height.value, error);
    const Parameter last = speed.arrival(-towards - height.value, error);
    if (!(first.error < kNever && last.error < kNever)) return {};
    if (first.t + first.error >= enter_low) enter_axis = first.t - first.error > enter_high ? axis : -1;
    enter_low = std::max(enter_low, first.t - first.error);
    enter_high = std::max(enter_high, first.t + first.error);
    if (last.t - last.error <= leave_high) leave_axis = last.t + last.error < leave_low ? axis : -1;
    leave_low = std::min(leave_low, last.t - last.error);
    leave_high = std::min(leave_high, last.t + last.error);
  }
  const double start = std::max(0.0, ray.t_min);
  if (enter_low > leave_high || leave_high < start || enter_low > ray.t_max) return {Sight::missed()};
  if (!(enter_high < leave_low)) return {};
  if (enter_low > start && enter_high < ray.t_max) return {{Kind::hit, enter_low, enter_high}, enter_axis, true};
  if (enter_high < start && leave_low > start && leave_high < ray.t_max)
    return {{Kind::hit, leave_low, leave_high}, leave_axis, false};
  return {{Kind::unsure, enter_low, leave_high}};
}

Sight sight(const Ray& ray, const Box& box) {
  return box_sight(ray, box).sight;
}

}  // namespace etendue
