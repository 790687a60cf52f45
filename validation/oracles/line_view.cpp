// SPDX-License-Identifier: Apache-2.0
#include "oracles/line_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "oracles/corners.hpp"

namespace etendue::oracle {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A polynomial of degree at most four: Σ c[k] x^k.
using Quartic = std::array<double, 5>;

double value(const Quartic& c, double x) {
  return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
}

/// Sign changes in [-1, 1], between those of the derivative.
std::vector<double> sign_changes(const Quartic& c, int degree) {
  if (degree == 0) return {};
  const Quartic slope{c[1], 2 * c[2], 3 * c[3], 4 * c[4], 0};
  std::vector<double> stops = sign_changes(slope, degree - 1);
  stops.insert(stops.begin(), -1.0);
  stops.push_back(1.0);
  std::vector<double> found;
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    double a = stops[k], b = stops[k + 1];
    const double f_a = value(c, a);
    if (!(f_a * value(c, b) < 0)) continue;
    // Monotone in between: Newton's steps, halved where they leave the interval.
    double x = 0.5 * (a + b);
    for (int step = 0; step < 80; ++step) {
      const double f = value(c, x);
      if (f == 0) break;
      (f * f_a > 0 ? a : b) = x;
      const double next = x - f / value(slope, x), before = x;
      x = next > a && next < b ? next : 0.5 * (a + b);
      if (std::abs(x - before) <= 1e-16) break;
    }
    found.push_back(x);
  }
  return found;
}

/// Angles at which a + b cos t + c sin t + d cos 2t + e sin 2t vanishes: with x the tangent of half the angle from 0, and
/// from π, a quartic in [-1, 1].
void add_angles(double a, double b, double c, double d, double e, std::vector<double>& angles) {
  for (const double side : {1.0, -1.0}) {
    const double p = side * b, q = side * c;
    for (const double x : sign_changes({a + p + d, 2 * q + 4 * e, 2 * a - 6 * d, 2 * q - 4 * e, a - p + d}, 4)) {
      const double angle = 2 * std::atan(x) + (side > 0 ? 0 : std::numbers::pi);
      angles.push_back(angle < 0 ? angle + kTurn : angle);
    }
  }
}

Flat flat(const Point& p) {
  return {p[0], p[1]};
}

}  // namespace

LightFrame LightFrame::of(const Point& direction) {
  const Point far = std::abs(direction[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  Point x = oracle::cross(far, direction);
  const double size = norm(x);
  for (double& v : x) v /= size;
  return {x, oracle::cross(direction, x), direction};
}

Point LightFrame::in(const Point& p) const {
  return {oracle::dot(p, x), oracle::dot(p, y), oracle::dot(p, along)};
}

Outline Outline::segment(Flat from, Flat to) {
  const Flat u = to - from;
  return {false, from, u, {0, 0}, from + 0.5 * u, 0.5 * std::hypot(u.x, u.y)};
}

Outline Outline::ellipse(Flat centre, Flat u, Flat v) {
  return {true, centre, u, v, centre, std::sqrt(oracle::dot(u, u) + oracle::dot(v, v))};
}

double Outline::end() const {
  return round ? kTurn : 1;
}

Flat Outline::at(double s) const {
  return round ? c + std::cos(s) * u + std::sin(s) * v : c + s * u;
}

Flat Outline::along(double s) const {
  return round ? std::cos(s) * v - std::sin(s) * u : u;
}

double Outline::swept(double from, double to) const {
  const double straight = oracle::cross(c, at(to) - at(from));
  return 0.5 * (round ? straight + (to - from) * oracle::cross(u, v) : straight);
}

void Outline::cross(const Outline& other, std::vector<double>& cuts) const {
  const Flat apart = other.middle - middle;
  const double reaches = reach + other.reach;
  if (oracle::dot(apart, apart) > reaches * reaches) return;
  if (!other.round) {
    // The side of the other's line: a + b cos + c sin, or a + b s.
    const double a = oracle::cross(other.u, c - other.c), b = oracle::cross(other.u, u);
    if (!round) {
      if (const double s = -a / b; b != 0 && s > 0 && s < 1) cuts.push_back(s);
      return;
    }
    const double w = oracle::cross(other.u, v), size = std::hypot(b, w);
    if (!(std::abs(a) < size)) return;
    const double towards = std::atan2(w, b), half = std::acos(-a / size);
    for (const double s : {towards - half, towards + half}) {
      cuts.push_back(s < 0 ? s + kTurn : s >= kTurn ? s - kTurn : s);
    }
    return;
  }
  const double area = oracle::cross(other.u, other.v);
  if (area == 0) return;
  // In the other's own coordinates it is the unit circle.
  const auto own = [&](Flat p) -> Flat { return {oracle::cross(p, other.v) / area, oracle::cross(other.u, p) / area}; };
  const Flat o = own(c - other.c), p = own(u);
  if (!round) {
    const double a = oracle::dot(p, p), b = oracle::dot(o, p), root = b * b - a * (oracle::dot(o, o) - 1);
    if (!(root > 0) || a == 0) return;
    for (const double s : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a}) {
      if (s > 0 && s < 1) cuts.push_back(s);
    }
    return;
  }
  const Flat q = own(v);
  const double pp = oracle::dot(p, p), qq = oracle::dot(q, q);
  add_angles(oracle::dot(o, o) - 1 + 0.5 * (pp + qq), 2 * oracle::dot(o, p), 2 * oracle::dot(o, q), 0.5 * (pp - qq),
             oracle::dot(p, q), cuts);
}

LitBody::LitBody(const RoundBody& body, const LightFrame& frame) : body_(body) {
  body_.centre = frame.in(body.centre);
  body_.axis = frame.in(body.axis);
  for (Point& corner : body_.corners) corner = frame.in(corner);
  for (Point& edge : body_.edges) edge = frame.in(edge);
  const BodyBall ball = ball_of(body_);
  middle_ = flat(ball.middle);
  reach_ = ball.size;
  const Flat centre = flat(body_.centre);
  const auto add_rim = [&](Flat middle, const Point& normal) {
    const LightFrame plane = LightFrame::of(normal);
    const double r = body_.radius;
    outlines_.push_back(Outline::ellipse(middle, r * flat(plane.x), r * flat(plane.y)));
  };
  switch (body_.kind) {
    case RoundBody::Kind::polygon:
      normal_ = newell(body_.corners);
      for (std::size_t k = 0; k < body_.corners.size(); ++k) {
        outlines_.push_back(
            Outline::segment(flat(body_.corners[k]), flat(body_.corners[(k + 1) % body_.corners.size()])));
      }
      break;
    case RoundBody::Kind::sphere:
      outlines_.push_back(Outline::ellipse(centre, {body_.radius, 0}, {0, body_.radius}));
      break;
    case RoundBody::Kind::disc:
      normal_ = body_.axis;
      add_rim(centre, normal_);
      break;
    case RoundBody::Kind::cylinder: {
      const double length = norm(body_.axis), r = body_.radius;
      normal_ = {body_.axis[0] / length, body_.axis[1] / length, body_.axis[2] / length};
      const Flat way = flat(body_.axis);
      const double seen = std::hypot(way.x, way.y);
      const Point aside = seen > 0 ? Point{-way.y / seen, way.x / seen, 0} : Point{1, 0, 0};
      // The silhouettes touch the rims at 0 and π: no crossing tells that, but every outline is cut there.
      const Flat u = r * flat(aside), v = r * flat(oracle::cross(normal_, aside));
      for (const Flat foot : {centre, centre + way}) outlines_.push_back(Outline::ellipse(foot, u, v));
      if (!(seen > 0)) break;
      outlines_.push_back(Outline::segment(centre + u, centre + u + way));
      outlines_.push_back(Outline::segment(centre - u, centre - u + way));
      break;
    }
    case RoundBody::Kind::box:
      for (std::size_t k = 0; k < 3; ++k) {
        const Point &i = body_.edges[(k + 1) % 3], &j = body_.edges[(k + 2) % 3];
        const Flat a = flat(i), b = flat(j), way = flat(body_.edges[k]);
        // Of the four edges along k those between a face that light meets and one that it does not.
        const bool opposite = (i[2] > 0) != (j[2] > 0);
        for (const Flat foot : opposite ? std::array{centre, centre + a + b} : std::array{centre + a, centre + b}) {
          outlines_.push_back(Outline::segment(foot, foot + way));
        }
      }
      break;
  }
}

std::optional<Crossing> LitBody::through_polygon(Flat line) const {
  const double front = normal_[2];
  if (front == 0) return std::nullopt;
  for (std::size_t k = 0; k < body_.corners.size(); ++k) {
    const Flat a = flat(body_.corners[k]), b = flat(body_.corners[(k + 1) % body_.corners.size()]);
    if (oracle::cross(b - a, line - a) * front < 0) return std::nullopt;
  }
  const Point& o = body_.corners.front();
  const double z = o[2] - (normal_[0] * (line.x - o[0]) + normal_[1] * (line.y - o[1])) / front;
  return Crossing{z, z, front<0, front> 0};
}

std::optional<Crossing> LitBody::through_cylinder(Flat line) const {
  const Point& n = normal_;
  const double length = norm(body_.axis);
  // p = (line, z) − base; height p · n, off the axis |p − (p · n) n|².
  const Point foot{line.x - body_.centre[0], line.y - body_.centre[1], -body_.centre[2]};
  const double h = oracle::dot(foot, n), slope = n[2];
  const Point off{foot[0] - h * n[0], foot[1] - h * n[1], foot[2] - h * n[2]};
  const Point way{-slope * n[0], -slope * n[1], 1 - slope * slope};
  const double a = oracle::dot(way, way), b = oracle::dot(off, way);
  const double c = oracle::dot(off, off) - body_.radius * body_.radius;
  Crossing wall{-1e300, 1e300, true, true};
  if (a > 0) {
    const double square = b * b - a * c;
    if (!(square > 0)) return std::nullopt;
    wall.in = (-b - std::sqrt(square)) / a, wall.out = (-b + std::sqrt(square)) / a;
  } else if (c > 0) {
    return std::nullopt;
  }
  if (slope == 0) return h >= 0 && h <= length ? std::optional(wall) : std::nullopt;
  const double z_0 = -h / slope, z_1 = (length - h) / slope;
  const double low = std::min(z_0, z_1), high = std::max(z_0, z_1);
  if (low > wall.in) wall.in = low, wall.enters_patch = false;
  if (high < wall.out) wall.out = high, wall.leaves_patch = false;
  return wall.in < wall.out ? std::optional(wall) : std::nullopt;
}

std::optional<Crossing> LitBody::through_box(Flat line) const {
  Crossing all{-1e300, 1e300, false, false};
  const Point foot{line.x - body_.centre[0], line.y - body_.centre[1], -body_.centre[2]};
  for (const Point& edge : body_.edges) {
    const double h = oracle::dot(foot, edge), slope = edge[2], size = oracle::dot(edge, edge);
    if (slope == 0) {
      if (h < 0 || h > size) return std::nullopt;
      continue;
    }
    const double z_0 = -h / slope, z_1 = (size - h) / slope;
    all.in = std::max(all.in, std::min(z_0, z_1));
    all.out = std::min(all.out, std::max(z_0, z_1));
  }
  return all.in < all.out ? std::optional(all) : std::nullopt;
}

std::optional<Crossing> LitBody::crossing(Flat line) const {
  const Flat apart = line - middle_;
  if (oracle::dot(apart, apart) > reach_ * reach_) return std::nullopt;
  switch (body_.kind) {
    case RoundBody::Kind::polygon:
      return through_polygon(line);
    case RoundBody::Kind::sphere: {
      const double square = body_.radius * body_.radius - oracle::dot(apart, apart);
      if (!(square > 0)) return std::nullopt;
      return Crossing{body_.centre[2] - std::sqrt(square), body_.centre[2] + std::sqrt(square), true, true};
    }
    case RoundBody::Kind::disc: {
      if (normal_[2] == 0) return std::nullopt;
      const double z = -(normal_[0] * apart.x + normal_[1] * apart.y) / normal_[2];
      if (oracle::dot(apart, apart) + z * z > body_.radius * body_.radius) return std::nullopt;
      return Crossing{body_.centre[2] + z, body_.centre[2] + z, normal_[2]<0, normal_[2]> 0};
    }
    case RoundBody::Kind::cylinder:
      return through_cylinder(line);
    default:
      return through_box(line);
  }
}

}  // namespace etendue::oracle
