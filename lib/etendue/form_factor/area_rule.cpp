// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/area_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

/// A quadrilateral as the bilinear image of [−1, 1]²; its signed Jacobian counts windings, so concave ones count right.
struct Quadrilateral {
  std::array<Vec3, 4> corners;
  double half_edge;  ///< largest |∂x/∂s|, |∂x/∂t|
  double jacobian;   ///< largest |∂x/∂s × ∂x/∂t|
};

Quadrilateral quadrilateral(const std::array<Vec3, 4>& c) {
  Quadrilateral q{c, 0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 forward = c[(i + 1) % 4] - c[i], backward = c[(i + 3) % 4] - c[i];
    q.half_edge = std::max(q.half_edge, 0.5 * forward.norm());
    q.jacobian = std::max(q.jacobian, 0.25 * forward.cross(backward).norm());
  }
  return q;
}

/// A fan around the first vertex, two triangles at a time.
std::vector<Quadrilateral> quadrilaterals(const std::vector<Vec3>& v) {
  std::vector<Quadrilateral> result;
  for (std::size_t i = 1; i + 1 < v.size(); i += 2) {
    const Vec3& last = i + 2 < v.size() ? v[i + 2] : v[0];
    result.push_back(quadrilateral({v[0], v[i], v[i + 1], last}));
  }
  return result;
}

struct WeightedPoint {
  Vec3 point;
  double weight;
};

void append_points(const Quadrilateral& q, const Vec3& normal, int n, std::vector<WeightedPoint>& points) {
  const auto& c = q.corners;
  for (const QuadratureNode& s : gauss_legendre(n)) {
    for (const QuadratureNode& t : gauss_legendre(n)) {
      const Vec3 along_s = 0.25 * ((1 - t.x) * (c[1] - c[0]) + (1 + t.x) * (c[2] - c[3]));
      const Vec3 along_t = 0.25 * ((1 - s.x) * (c[3] - c[0]) + (1 + s.x) * (c[2] - c[1]));
      const Vec3 point = c[0] +
                         (1 + s.x) * 0.5 * ((1 - 0.5 * (1 + t.x)) * (c[1] - c[0]) + 0.5 * (1 + t.x) * (c[2] - c[3])) +
                         0.5 * (1 + t.x) * (c[3] - c[0]);
      points.push_back({point, along_s.cross(along_t).dot(normal) * s.weight * t.weight});
    }
  }
}

struct Ball {
  Vec3 centre;
  double radius;
};

Ball enclosing_ball(const std::vector<Vec3>& points) {
  Ball ball{Vec3::Zero(), 0};
  for (const Vec3& p : points) ball.centre += p / static_cast<double>(points.size());
  for (const Vec3& p : points) ball.radius = std::max(ball.radius, (p - ball.centre).norm());
  return ball;
}

/// What the truncation of the tensor rule rests on.
struct Separation {
  double gap;       ///< lower bound on r
  double height_1;  ///< largest height of second above first's plane
  double height_2;  ///< largest height of first above second's plane
};

/// Truncation of the n-point rule in one variable, the integrand analytic outside the ellipse of `gap` (NOTES.md §4).
double one_variable(const Separation& apart, double half_edge, double jacobian, int n) {
  if (half_edge == 0) return 0;
  const double distance = apart.gap / half_edge;
  const double singular = distance + std::hypot(1, distance);
  const double rho = 1 + (singular - 1) * n / (n + 2.0);
  const double semi_axis = 0.5 * (rho + 1 / rho);
  const double clearance = half_edge * 0.5 * (singular - rho) * (1 - 1 / (singular * rho));
  const double kernel = apart.height_1 * apart.height_2 * semi_axis * semi_axis / std::pow(clearance, 4);
  return jacobian * kernel * analytic_truncation(n, rho);
}

double truncation(const std::vector<Quadrilateral>& from, const std::vector<Quadrilateral>& to, const Separation& apart,
                  int n) {
  double total = 0;
  for (const auto& a : from) {
    for (const auto& b : to) {
      // Two variables of each kind; the other three carry weight 2 each.
      total += 2 * 8 * b.jacobian * one_variable(apart, a.half_edge, a.jacobian, n);
      total += 2 * 8 * a.jacobian * one_variable(apart, b.half_edge, b.jacobian, n);
    }
  }
  return 2 * total;
}

}  // namespace

std::optional<QuadratureSum> double_area(const Loop& first, const Loop& second, const Vec3& offset, double goal,
                                         int max_nodes) {
  const Ball ball_1 = enclosing_ball(first.vertices), ball_2 = enclosing_ball(second.vertices);
  Separation apart{(offset + (ball_2.centre - ball_1.centre)).norm() - ball_1.radius - ball_2.radius, 0, 0};
  if (!(apart.gap > std::max(ball_1.radius, ball_2.radius))) return std::nullopt;
  const Vec3 base = offset + (second.vertices.front() - first.vertices.front());
  double reach = 0;
  for (const Vec3& v : second.vertices) {
    const Vec3 r = base + (v - second.vertices.front());
    apart.height_1 = std::max(apart.height_1, std::abs(r.dot(first.normal)));
    reach = std::max(reach, r.norm());
  }
  for (const Vec3& v : first.vertices) {
    apart.height_2 = std::max(apart.height_2, std::abs((base - (v - first.vertices.front())).dot(second.normal)));
  }
  const auto from = quadrilaterals(first.vertices), to = quadrilaterals(second.vertices);
  QuadratureSum sum;
  int n = 2;
  for (; n <= max_nodes; ++n) {
    sum.truncation = truncation(from, to, apart, n);
    if (sum.truncation <= goal) break;
  }
  if (n > max_nodes) return std::nullopt;

  std::vector<WeightedPoint> points_1, points_2;
  for (const auto& q : from) append_points(q, first.normal, n, points_1);
  for (const auto& q : to) append_points(q, second.normal, n, points_2);
  double mass_1 = 0, mass_2 = 0;
  for (const auto& b : points_2) mass_2 += std::abs(b.weight);
  for (const auto& a : points_1) {
    mass_1 += std::abs(a.weight);
    double inner = 0;
    const Vec3 start = offset - a.point;
    for (const auto& b : points_2) {
      const Vec3 r = start + b.point;
      const double square = r.squaredNorm();
      inner -= b.weight * r.dot(first.normal) * r.dot(second.normal) / (square * square);
    }
    sum.value += 2 * a.weight * inner;
  }
  constexpr double kKernelRoundings = 24;  // counted in NOTES.md §4
  const double kernel = (apart.height_1 + apart.height_2) * (reach + ball_1.radius) / std::pow(apart.gap, 4);
  sum.rounding = 2 * kKernelRoundings * kUnitRoundoff * mass_1 * mass_2 *
                 (apart.height_1 * apart.height_2 / std::pow(apart.gap, 4) + kernel);
  return sum;
}

}  // namespace etendue
