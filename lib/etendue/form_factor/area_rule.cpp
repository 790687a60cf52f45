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
};

/// What the truncation needs of all quadrilaterals of a loop.
struct Shape {
  std::array<double, 2> half_edge{};  ///< largest |∂x/∂s|, |∂x/∂t|
  double jacobians = 0;               ///< sum of the largest |∂x/∂s × ∂x/∂t|
  double products = 0;  ///< sum of the largest |∂x/∂s| |∂x/∂t|: what the Jacobians' rounding is a share of
};

void include(const Quadrilateral& q, Shape& shape) {
  const auto& c = q.corners;
  const double along_s = 0.5 * std::max((c[1] - c[0]).norm(), (c[2] - c[3]).norm());
  const double along_t = 0.5 * std::max((c[3] - c[0]).norm(), (c[2] - c[1]).norm());
  shape.half_edge = {std::max(shape.half_edge[0], along_s), std::max(shape.half_edge[1], along_t)};
  shape.products += along_s * along_t;
  double jacobian = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    jacobian = std::max(jacobian, 0.25 * (c[(i + 1) % 4] - c[i]).cross(c[(i + 3) % 4] - c[i]).norm());
  }
  shape.jacobians += jacobian;
}

/// A fan around the first vertex, two triangles at a time.
void append_quadrilaterals(const std::vector<Vec3>& v, std::vector<Quadrilateral>& result) {
  for (std::size_t i = 1; i + 1 < v.size(); i += 2) {
    const Vec3& last = i + 2 < v.size() ? v[i + 2] : v[0];
    result.push_back({{v[0], v[i], v[i + 1], last}});
  }
}

/// A node on the bilinear surface, and the piece of surface it stands for: the flux through any surface with the same
/// boundary is the same, so vertices that rounding moved off their plane do no harm.
struct SurfacePoint {
  Vec3 point;
  Vec3 area;
};

void append_points(const Quadrilateral& q, const std::array<int, 2>& n, std::vector<SurfacePoint>& points) {
  const auto& c = q.corners;
  for (const QuadratureNode& s : gauss_legendre(n[0])) {
    for (const QuadratureNode& t : gauss_legendre(n[1])) {
      const Vec3 along_s = 0.25 * ((1 - t.x) * (c[1] - c[0]) + (1 + t.x) * (c[2] - c[3]));
      const Vec3 along_t = 0.25 * ((1 - s.x) * (c[3] - c[0]) + (1 + s.x) * (c[2] - c[1]));
      const Vec3 point = c[0] +
                         (1 + s.x) * 0.5 * ((1 - 0.5 * (1 + t.x)) * (c[1] - c[0]) + 0.5 * (1 + t.x) * (c[2] - c[3])) +
                         0.5 * (1 + t.x) * (c[3] - c[0]);
      points.push_back({point, (s.weight * t.weight) * along_s.cross(along_t)});
    }
  }
}

/// What the truncation of the tensor rule rests on.
struct Separation {
  double gap;       ///< lower bound on r
  double height_1;  ///< largest height of second above first's plane
  double height_2;  ///< largest height of first above second's plane
};

/// Bounds the truncation of the n-point rule in one variable for a kernel that is analytic outside the ellipse of
/// `gap`, Jacobian of size one (NOTES.md §4).
double one_variable(const Separation& apart, double half_edge, int n) {
  const double distance = apart.gap / half_edge;
  const double singular = distance + std::hypot(1, distance);
  const double rho = 1 + (singular - 1) * n / (n + 2.0);
  const double semi_axis = 0.5 * (rho + 1 / rho);
  const double clearance = half_edge * 0.5 * (singular - rho) * (1 - 1 / (singular * rho));
  const double squared = clearance * clearance;
  const double kernel = apart.height_1 * apart.height_2 * semi_axis * semi_axis / (squared * squared);
  return kernel * analytic_truncation(n, rho);
}

/// Nodes in the two directions of each loop, and the truncation they leave.
struct Plan {
  std::array<std::array<int, 2>, 2> nodes{};
  double truncation = 0;
  double evaluations = 1;
};

std::optional<Plan> plan(const std::array<Shape, 2>& shapes, const Separation& apart, double goal, double budget) {
  constexpr double kOtherVariables = 8;  // three rules of total weight 2 each
  constexpr double kIntegrand = 2;       // the kernel is 2 cos cos / r²
  const double weight = kIntegrand * kOtherVariables * shapes[0].jacobians * shapes[1].jacobians;
  Plan result;
  for (std::size_t loop = 0; loop < 2; ++loop) {
    for (std::size_t direction = 0; direction < 2; ++direction) {
      const double half_edge = shapes[loop].half_edge[direction];
      // The first guess at the least number of nodes that reaches a quarter of the goal.
      int n = 2;
      double truncation = 0;
      for (;; ++n) {
        truncation = weight * one_variable(apart, half_edge, n);
        if (truncation <= 0.25 * goal) break;
        if (n == kMaxGaussNodes || result.evaluations * (n + 1) > budget) return std::nullopt;
      }
      result.nodes[loop][direction] = n;
      result.truncation += truncation;
      result.evaluations *= n;
    }
  }
  if (result.evaluations > budget) return std::nullopt;
  return result;
}

double tilt(const Loop& loop, double extent) {
  return 8 * loop.flatness * extent / loop.area;
}

}  // namespace

std::optional<QuadratureSum> double_area(std::span<const Loop> first, std::span<const Loop> second, const Vec3& offset,
                                         double goal, double budget) {
  // Holes lie inside the outlines: distances, heights and radii are theirs.
  const Loop &outline_1 = first.front(), &outline_2 = second.front();
  const double radius_1 = radius(outline_1.vertices), radius_2 = radius(outline_2.vertices);
  Separation apart{least_distance(outline_1, outline_2, offset), 0, 0};
  if (!(apart.gap > 0)) return std::nullopt;
  double reach = 0;
  for (const Vec3& v : outline_2.vertices) {
    const Vec3 r = offset + v - outline_1.vertices.front();
    apart.height_1 = std::max(apart.height_1, std::abs(r.dot(outline_1.normal)));
    reach = std::max(reach, r.norm());
  }
  for (const Vec3& v : outline_1.vertices) {
    apart.height_2 =
        std::max(apart.height_2, std::abs((offset + outline_2.vertices.front() - v).dot(outline_2.normal)));
  }
  // Vertices off the plane tilt the surface by about flatness · extent / area.
  apart.height_1 += tilt(outline_1, radius_1) * reach;
  apart.height_2 += tilt(outline_2, radius_2) * reach;
  std::vector<Quadrilateral> from, to;
  for (const Loop& loop : first) append_quadrilaterals(loop.vertices, from);
  for (const Loop& loop : second) append_quadrilaterals(loop.vertices, to);
  std::array<Shape, 2> shapes;
  for (const auto& q : from) include(q, shapes[0]);
  for (const auto& q : to) include(q, shapes[1]);
  const auto quads = static_cast<double>(from.size() * to.size());
  const auto chosen = plan(shapes, apart, goal, budget / quads);
  if (!chosen) return std::nullopt;

  QuadratureSum sum;
  sum.truncation = chosen->truncation;
  std::vector<SurfacePoint> points_1, points_2;
  for (const auto& q : from) append_points(q, chosen->nodes[0], points_1);
  for (const auto& q : to) append_points(q, chosen->nodes[1], points_2);
  for (const auto& a : points_1) {
    double inner = 0;
    const Vec3 start = offset - a.point;
    for (const auto& b : points_2) {
      const Vec3 r = start + b.point;
      const double square = r.squaredNorm();
      inner -= r.dot(a.area) * r.dot(b.area) / (square * square);
    }
    sum.value += 2 * inner;
  }
  constexpr double kDot = 12, kFourthPower = 16, kOwn = 4;  // counted in NOTES.md §4
  constexpr double kWeights = 16;                           // the rules' weights sum up to 2 in each of four variables
  const double span = reach + radius_1 + radius_2, fourth = std::pow(apart.gap, 4);
  const double heights = apart.height_1 * apart.height_2;
  const double kernel =
      heights * (kOwn + kFourthPower * span / apart.gap) + kDot * (apart.height_1 + apart.height_2) * span;
  const auto terms = static_cast<double>(points_1.size() + points_2.size());
  sum.rounding =
      2 * kWeights * kUnitRoundoff * shapes[0].products * shapes[1].products * (kernel + terms * heights) / fourth;
  return sum;
}

}  // namespace etendue
