// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/point_round.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/form_factor/catalogue/round_formulas.hpp"
#include "etendue/geometry/meeting.hpp"

namespace etendue {

namespace {

using catalogue::Counted;

using CountedVector = std::array<Counted, 3>;

Counted dot(const CountedVector& a, const CountedVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
CountedVector cross(const CountedVector& a, const CountedVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
CountedVector operator*(const Counted& k, const CountedVector& a) {
  return {k * a[0], k * a[1], k * a[2]};
}
CountedVector operator+(const CountedVector& a, const CountedVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Counted length(const CountedVector& a) {
  return sqrt(square(a[0]) + square(a[1]) + square(a[2]));
}
CountedVector exact(const Vec3& a) {
  return {Counted(a.x()), Counted(a.y()), Counted(a.z())};
}
CountedVector unit(const Vec3& a) {
  const CountedVector v = exact(a);
  const Counted size = length(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}

bool certainly_positive(const Counted& a) {
  return a.value.high > a.error;
}
bool certainly_negative(const Counted& a) {
  return a.value.high < -a.error;
}
double magnitude(const Counted& a) {
  return std::abs(a.value.high) + a.error;
}

/// The centre as seen from the point, exactly, and the radius; scaled by a power of two to order one.
struct Seen {
  CountedVector centre;
  Counted radius;
};
Seen seen_from(const Vec3& point, const Vec3& centre, double radius) {
  const double size = std::max((centre - point).cwiseAbs().maxCoeff(), radius),
               scale = std::ldexp(1.0, -std::ilogb(size));
  const auto component = [&](Eigen::Index k) {
    const DoubleDouble difference = exact_difference(centre[k], point[k]);
    return Counted(DoubleDouble(scale * difference.high, scale * difference.low), 0);
  };
  return {{component(0), component(1), component(2)}, Counted(scale * radius)};
}

Bounded held(const Counted& value) {
  const Bounded factor = bounded(value);
  // Holds for the truth: moving the value there only brings it nearer.
  return {std::clamp(factor.value, 0.0, 1.0), std::min(factor.bound, 1.0)};
}

/// atan(z)/z and ln(1 + y)/y with their series where the argument's relative error is of no matter.
Counted atan_over(const Counted& z) {
  constexpr double kSmall = 0x1p-20;
  if (magnitude(z) >= kSmall) return atan(z) / z;
  Counted series = Counted(1) - square(z) / 3;
  series.error += std::pow(magnitude(z), 4) / 4;
  return series;
}
Counted log1p_over(const Counted& y) {
  constexpr double kSmall = 0x1p-26;
  if (magnitude(y) >= kSmall) return log1p(y) / y;
  Counted series = Counted(1) - y / 2 + square(y) / 3;
  series.error += std::pow(magnitude(y), 3) / 3;
  return series;
}

/// A disc before an element's horizon.
class CutDisc {
 public:
  CutDisc(const Seen& seen, const CountedVector& normal, const CountedVector& axis)
      : seen_(seen), normal_(normal), axis_(axis) {
    height_ = -dot(axis, seen.centre);
    aside_ = seen.centre + height_ * axis;
    lateral_ = length(cross(axis, seen.centre));
    steep_ = length(cross(normal, axis));
  }

  const Counted& height() const { return height_; }
  /// Height of the disc's lowest and of its highest point over the horizon.
  Counted lowest() const { return dot(normal_, seen_.centre) - seen_.radius * steep_; }
  Counted highest() const { return dot(normal_, seen_.centre) + seen_.radius * steep_; }
  /// Of the nearest point of the rim.
  double nearest() const {
    const double l = lateral_.value.high - seen_.radius.value.high;
    return std::hypot(l, height_.value.high);
  }

  bool beside() const { return certainly_positive(lateral_ - seen_.radius); }

  Counted whole() const {
    const Counted across = -dot(normal_, axis_);
    return across * facing_disc(lateral_, height_, seen_.radius) +
           dot(normal_, aside_) * beside_disc(lateral_, height_, seen_.radius);
  }

  // NOTES.md §13: the arc from −T to T around the highest point, then the chord.
  Counted cut() const {
    const Counted r = seen_.radius, width = r * steep_, level = dot(normal_, seen_.centre);
    const Counted cosine = -(level / width), sine = sqrt((width - level) * (width + level)) / width;
    const Counted across = dot(normal_, axis_);
    const CountedVector up = normal_ + (-across) * axis_;
    const Counted per_up = Counted(1) / steep_;
    const CountedVector u = per_up * up, v = cross(axis_, u);
    const Counted half = atan2(sine, cosine);

    const CountedVector mid = seen_.centre + (r * cosine) * u;
    const Counted chord = r * sine;
    const Counted gamma = atan2(2 * chord * length(cross(mid, v)), dot(mid, mid) - square(chord));
    return (arc(u, v, cosine, sine, half) + gamma) / (2 * catalogue::pi());
  }

 private:
  Counted arc(const CountedVector& u, const CountedVector& v, const Counted& cosine, const Counted& sine,
              const Counted& half) const {
    const Counted& r = seen_.radius;
    const CountedVector& c = seen_.centre;
    const Counted a0 = -(square(r) * dot(normal_, axis_));
    const Counted a1 = -(r * dot(normal_, cross(c, v))), a2 = r * dot(normal_, cross(c, u));
    const Counted q0 = dot(c, c) + square(r), s = near_by_far(lateral_, height_, r);
    // Near the axis |p|² hardly varies: what its variation Q < 2^-60 q0 changes is left out and counted.
    constexpr double kOnAxis = 0x1p-60;
    Counted q = 2 * r * lateral_, cos_phi(1), sin_phi(0);
    double left_out = 0;
    if (magnitude(q) > kOnAxis * q0.value.high) {
      cos_phi = 2 * r * dot(c, u) / q;
      sin_phi = 2 * r * dot(c, v) / q;
    } else {
      left_out = 16 * magnitude(q) / q0.value.high * (magnitude(a0) + magnitude(a1) + magnitude(a2)) / q0.value.high;
      q = Counted(0);
    }
    const Counted scale = Counted(1) / (q0 + s), beta = q * scale;
    const Counted cos_a = cosine * cos_phi - sine * sin_phi, sin_a = -(sine * cos_phi) - cosine * sin_phi;
    const Counted cos_b = cosine * cos_phi + sine * sin_phi, sin_b = sine * cos_phi - cosine * sin_phi;
    const auto lag = [&](const Counted& cos_t, const Counted& sin_t) {
      const Counted share = sin_t / (Counted(1) + beta * cos_t);
      return atan_over(beta * share) * share * scale;
    };
    const Counted lags = lag(cos_b, sin_b) - lag(cos_a, sin_a);
    const Counted span = 2 * half - 2 * q * lags;
    const Counted ratio = (cos_b - cos_a) / (q0 + q * cos_a);
    Counted sum = a0 * (span / s) + (a1 * cos_phi + a2 * sin_phi) * (2 * lags - span * (q / s) * scale) -
                  (a2 * cos_phi - a1 * sin_phi) * (log1p_over(q * ratio) * ratio);
    sum.error += left_out;
    return sum;
  }

  const Seen& seen_;
  const CountedVector& normal_;
  const CountedVector& axis_;
  Counted height_, lateral_, steep_;
  CountedVector aside_;
};

/// Lengths whose ratio is beyond leave the domain of Counted; the factor is below 2^-400 then.
constexpr double kFarthest = 0x1p-200;

}  // namespace

Bounded point_to_disc(const Vec3& point, const Vec3& normal, const Disc& disc) {
  require(point.allFinite() && disc.centre.allFinite(), "point_to_disc: point and centre are finite");
  require(is_unit_normal(normal) && is_unit_normal(disc.normal), "point_to_disc: normals are unit vectors");
  require(disc.radius > 0 && std::isfinite(disc.radius), "point_to_disc: the radius is positive and finite");
  const Seen seen = seen_from(point, disc.centre, disc.radius);
  if (seen.radius.value.high < kFarthest) return {0, 0x1p-399};
  const CountedVector n = unit(normal), axis = unit(disc.normal);
  const CutDisc cut(seen, n, axis);
  if (!certainly_positive(cut.height())) {
    constexpr double kExactlyZero = 0x1p-300;  // of numbers of order one only exact zeros are known so well
    if (certainly_negative(cut.height()) || cut.height().error < kExactlyZero) return {0, 0};
    // Beside the disc it is seen at an angle of at most the height's error over the distance; over it, it may fill all.
    return {0, cut.beside() ? std::min(1.0, 4 * cut.height().error / cut.nearest()) : 1};
  }
  const Counted lowest = cut.lowest(), highest = cut.highest();
  if (certainly_negative(highest)) return {0, 0};
  if (!certainly_positive(highest)) return {0, std::min(1.0, 2 * magnitude(highest) / cut.nearest())};
  if (certainly_negative(lowest)) return held(cut.cut());
  Bounded whole = held(cut.whole());
  // Where it may dip below by rounding, what dips is seen at so low an angle.
  if (!certainly_positive(lowest)) whole.bound = std::min(1.0, whole.bound + 2 * magnitude(lowest) / cut.nearest());
  return whole;
}

Bounded point_to_sphere(const Vec3& point, const Vec3& normal, const Sphere& sphere) {
  require(point.allFinite() && sphere.centre.allFinite(), "point_to_sphere: point and centre are finite");
  require(is_unit_normal(normal), "point_to_sphere: normal is a unit vector");
  require(sphere.radius > 0 && std::isfinite(sphere.radius), "point_to_sphere: the radius is positive and finite");
  const Seen seen = seen_from(point, sphere.centre, sphere.radius);
  if (seen.radius.value.high < kFarthest) return {0, 0x1p-399};
  const CountedVector n = unit(normal);
  const Counted distance = length(seen.centre);
  Counted radius = seen.radius;
  double sunk = 0;
  if (certainly_negative(distance - radius)) {
    const Counted depth = Counted(1) - distance / radius;
    require(magnitude(depth) <= kOnSphere, "point_to_sphere: the point is not inside the sphere");
    sunk = 2 * std::sqrt(magnitude(depth));
    radius = distance;
  }
  const Counted height = dot(n, seen.centre) / radius, aside = length(cross(n, seen.centre)) / radius;
  if (certainly_negative(height + Counted(1))) return {0, 0};
  Bounded factor = held(cut_sphere(height, aside));
  factor.bound = std::min(1.0, factor.bound + sunk);
  return factor;
}

}  // namespace etendue
