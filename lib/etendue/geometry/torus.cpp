// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/torus.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/curved_meeting.hpp"

namespace etendue {

namespace {

// Share of the terms' size that each coefficient loses: at most 24 operations of 2^-102 each, NOTES.md §10.
constexpr double kLoss = 0x1p-97;

/// (|x|² + R² − r²)² |A|² − 4R² (|x|² |A|² − (A·x)²) as a polynomial in s: negative inside.
BoundedPolynomial quartic(const NearLine& line, const Vec3& direction, const Torus& torus) {
  const DoubleDouble3 d = widened(direction), axis = widened(torus.axis);
  const DoubleDouble ring2 = exact_product(torus.ring, torus.ring);
  const DoubleDouble gap2 = ring2 - exact_product(torus.tube, torus.tube);
  const DoubleDouble n2 = dot(axis, axis), a = dot(d, d), b = dot(line.start, d), square = dot(line.start, line.start);
  const DoubleDouble along = dot(axis, d), height = dot(line.start, axis);
  const DoubleDouble c = square + gap2;
  // |x|²|A|² − (A·x)² = h2 s² + 2 h1 s + h0
  const DoubleDouble h2 = a * n2 - along * along, h1 = b * n2 - along * height, h0 = square * n2 - height * height;
  const DoubleDouble ring4 = ring2 * 4.0;
  BoundedPolynomial p;
  p.coefficient = {n2 * c * c - ring4 * h0, n2 * b * c * 4.0 - ring4 * h1 * 2.0,
                   n2 * (b * b * 4.0 + a * c * 2.0) - ring4 * h2, n2 * a * b * 4.0, n2 * a * a};
  // Every term of coefficient k is at most |A|² |D|^k (|start| + 2R)^(4−k) times a few; start's error enters fourfold.
  const double size = line.distance + 2 * torus.ring, speed = direction.norm();
  const double share = 16 * (kLoss + 8 * line.start_error / size);
  double scale = n2.high * share;
  for (std::size_t k = 0; k <= 4; ++k) {
    double term = scale;
    for (std::size_t i = 0; i < 4; ++i) term *= i < k ? speed : size;
    p.error[k] = term;
  }
  return p;
}

/// The part of the line inside the sphere around the torus, a little widened; empty where it passes outside. Its middle is
/// the closest approach anew: `start` is that only to roundings of the way there, which from afar exceed the widening.
std::optional<ParameterRange> range_within(const NearLine& line, const Vec3& direction, const Torus& torus) {
  const DoubleDouble3 d = widened(direction);
  const double a = dot(d, d).high, b = dot(line.start, d).high, square = line.distance * line.distance;
  const double reach = (torus.ring + torus.tube) * (1 + 0x1p-40);
  const double left = reach * reach - (square - b / a * b) + 0x1p-40 * square;
  if (!(left > 0)) return std::nullopt;
  const double middle = -b / a, half = (std::sqrt(left) + 0x1p-40 * (reach + line.distance)) / std::sqrt(a);
  return ParameterRange{middle - half, middle + half};
}

}  // namespace

std::optional<Hit> intersect(const Ray& ray, const Torus& torus) {
  require_direction(ray);
  require(torus.tube > 0 && torus.tube < torus.ring && std::isfinite(torus.ring),
          "intersect: the torus's radii are finite, 0 < tube < ring");
  require(torus.centre.allFinite() && torus.axis.allFinite() && torus.axis.squaredNorm() > 0,
          "intersect: the torus's centre is finite, its axis finite and not zero");
  const NearLine line(ray, torus.centre);
  const auto range = range_within(line, ray.direction, torus);
  if (!range) return std::nullopt;
  const auto met =
      first_meeting(ray, line, quartic(line, ray.direction, torus), *range, [](const BoundedZero&) { return true; });
  if (!met) return std::nullopt;
  const Vec3 x = met->place, axis = torus.axis.stableNormalized();
  const double height = axis.dot(x);
  const Vec3 radial = (x - height * axis).normalized();
  Hit hit;
  hit.t = met->t;
  hit.normal = (x - torus.ring * radial).normalized();
  hit.point = torus.centre + (torus.ring * radial + torus.tube * hit.normal);
  // Axis, radial and normal are each a few roundings off a unit vector: NOTES.md §10.
  hit.surface_error = kUnitRoundoff * (2 * hit.point.lpNorm<1>() + 32 * (torus.ring + torus.tube));
  hit.point_error = hit.surface_error + met->place_error;
  const TangentFrame frame = tangent_frame(axis);
  hit.uv = {turn_of(frame.u.dot(radial), frame.v.dot(radial)), turn_of(radial.dot(hit.normal), axis.dot(hit.normal))};
  return hit;
}

}  // namespace etendue
