// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/view_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace etendue {

namespace {

constexpr double kLongestArc = 2 * std::numbers::pi / 3;

/// atan(z)/z and ln(1 + y)/y, which are 1 at 0 within z²/3 and |y|/2.
double atan_over(double z) {
  constexpr double kTiny = 0x1p-27;
  return std::abs(z) < kTiny ? 1 : std::atan(z) / z;
}
double log1p_over(double y) {
  constexpr double kTiny = 0x1p-54;
  return std::abs(y) < kTiny ? 1 : std::log1p(y) / y;
}

}  // namespace

ViewCurve ViewCurve::segment(const Vec3& from, const Vec3& to) {
  ViewCurve curve;
  curve.p0_ = from;
  curve.p1_ = to - from;
  curve.p2_ = Vec3::Zero();
  return curve;
}

void ViewCurve::add_arc(const Vec3& centre, const Vec3& u, const Vec3& v, double begin, double end,
                        std::vector<ViewCurve>& curves) {
  const int pieces = std::max(1, static_cast<int>(std::ceil((end - begin) / kLongestArc)));
  for (int k = 0; k < pieces; ++k) {
    const double half = 0.5 * (end - begin) / pieces, middle = begin + (2 * k + 1) * half;
    ViewCurve curve;
    curve.arc_ = true;
    curve.centre_ = centre;
    curve.u_ = std::cos(middle) * u + std::sin(middle) * v;
    curve.v_ = std::cos(middle) * v - std::sin(middle) * u;
    // (1 + x²) cos t = 1 − x², (1 + x²) sin t = 2x.
    curve.p0_ = centre + curve.u_;
    curve.p1_ = 2 * curve.v_;
    curve.p2_ = centre - curve.u_;
    curve.end_ = std::tan(0.5 * half);
    curve.begin_ = -curve.end_;
    curves.push_back(curve);
  }
}

double ViewCurve::distance(double x) const {
  return direction(x).norm() / (arc_ ? 1 + x * x : 1);
}

void ViewCurve::cut_by_plane(const Vec3& normal, std::vector<double>& cuts) const {
  add_sign_changes({normal.dot(p0_), normal.dot(p1_), normal.dot(p2_), 0, 0}, begin_, end_, cuts);
}

void ViewCurve::cut_by_cone(const Mat3& quadric, std::vector<double>& cuts) const {
  const Vec3 q0 = quadric * p0_, q1 = quadric * p1_, q2 = quadric * p2_;
  add_sign_changes({p0_.dot(q0), 2 * p0_.dot(q1), p1_.dot(q1) + 2 * p0_.dot(q2), 2 * p1_.dot(q2), p2_.dot(q2)}, begin_,
                   end_, cuts);
}

double ViewCurve::share(double x_a, double x_b, const Vec3& normal) const {
  constexpr double kPerTurn = 0.5 / std::numbers::pi;
  return kPerTurn * (arc_ ? arc_integral(x_a, x_b, normal) : segment_integral(x_a, x_b, normal));
}

double ViewCurve::segment_integral(double x_a, double x_b, const Vec3& normal) const {
  const Vec3 a = direction(x_a), b = direction(x_b);
  const Vec3 across = ((x_b - x_a) * p1_).cross(a.squaredNorm() < b.squaredNorm() ? a : b);
  const double size = across.norm();
  return size > 0 ? std::atan2(size, a.dot(b)) * across.dot(normal) / size : 0;
}

// n · (p' × p) = a_0 + a_1 cos t + a_2 sin t and |p|² = q_0 + Q cos(t − φ); the three integrals without cancellation:
// NOTES.md §13.
double ViewCurve::arc_integral(double x_a, double x_b, const Vec3& normal) const {
  const double radius = u_.norm();
  const Vec3 axis = u_.cross(v_) / (radius * radius);
  const double a0 = -normal.dot(axis) * radius * radius;
  const double a1 = -normal.dot(centre_.cross(v_)), a2 = normal.dot(centre_.cross(u_));
  const double q0 = centre_.squaredNorm() + radius * radius;
  const double q1 = 2 * centre_.dot(u_), q2 = 2 * centre_.dot(v_), q = std::hypot(q1, q2);
  const double cos_phi = q > 0 ? q1 / q : 1, sin_phi = q > 0 ? q2 / q : 0;
  const double lateral = q / (2 * radius), height = centre_.dot(axis);
  const double s = std::hypot(lateral - radius, height) * std::hypot(lateral + radius, height);
  if (!(s > 0)) return 0;  // the eye is on the circle
  const double beta = q / (q0 + s), scale = 1 / (q0 + s);
  const auto turned = [&](double x) {
    const double c = (1 - x) * (1 + x) / (1 + x * x), sine = 2 * x / (1 + x * x);
    return Vec2(c * cos_phi + sine * sin_phi, sine * cos_phi - c * sin_phi);
  };
  const Vec2 a = turned(x_a), b = turned(x_b);
  const auto lag = [&](const Vec2& t) {  // atan(z)/Q, z = β sin/(1 + β cos)
    const double share = t.y() / (1 + beta * t.x());
    return atan_over(beta * share) * share * scale;
  };
  const double lags = lag(b) - lag(a);
  const double span = 2 * std::atan2(x_b - x_a, 1 + x_a * x_b) - 2 * q * lags;
  const double distance_a = q0 + q * a.x(), ratio = (b.x() - a.x()) / distance_a;
  const double plain = span / s;
  const double cosine = 2 * lags - span * (q / s) * scale;
  const double sine = -log1p_over(q * ratio) * ratio;
  return a0 * plain + (a1 * cos_phi + a2 * sin_phi) * cosine + (a2 * cos_phi - a1 * sin_phi) * sine;
}

}  // namespace etendue
