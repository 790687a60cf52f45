// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "etendue/form_factor/certified_contour.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

/// corner + s (along + t across), s and t in [0, 1]: flat whatever its corners are, and of Jacobian s · across_along.
struct Triangle {
  Interval3 corner, along, across;
  Interval3 doubled;  ///< along × across: the normal times twice the area
};

std::vector<Triangle> fan(const EnclosedOutline& outline) {
  std::vector<Triangle> result;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const Interval3 along = outline[i] - outline[0], across = outline[i + 1] - outline[i];
    result.push_back({Interval3(), along, across, cross(along, across)});
  }
  return result;
}

Vec3 mean_of(const EnclosedOutline& outline) {
  Vec3 sum = Vec3::Zero();
  for (const Interval3& v : outline) sum += v.middle();
  return sum / static_cast<double>(outline.size());
}

/// How far apart, for certain, the two outlines' hulls are along `direction`.
double gap_along(const Vec3& direction, const EnclosedOutline& first, const EnclosedOutline& second) {
  const Interval3 way(direction);
  // From the first corner of the first: the digits of a common offset do not count.
  double highest = 0, lowest = 0;
  for (const Interval3& v : first) highest = std::max(highest, dot(way, v - first[0]).upper);
  for (std::size_t i = 0; i < second.size(); ++i) {
    const double level = dot(way, second[i] - first[0]).lower;
    lowest = i == 0 ? level : std::min(lowest, level);
  }
  const double gap = ((Interval(lowest) - highest) / norm(way)).lower;
  return gap > 0 ? gap : 0;
}

Vec3 normal_of(const EnclosedOutline& outline) {
  Vec3 sum = Vec3::Zero();
  for (const Triangle& t : fan(outline)) sum += t.doubled.middle();
  return sum;
}

double least_gap(const EnclosedOutline& first, const EnclosedOutline& second) {
  const Vec3 between = mean_of(second) - mean_of(first);
  return std::max({gap_along(between, first, second), gap_along(normal_of(first), first, second),
                   gap_along(-normal_of(second), first, second)});
}

/// What the truncation of one pair of triangles rests on.
struct Reach {
  double gap;
  Interval numerator;  ///< bounds the product of the heights, each with twice the area
};

/// The truncation of the n-point rule in one variable, length `edge` of its line at most; NOTES.md §4.
double one_variable(const Reach& reach, double edge, int n) {
  const Interval half = Interval(0.5) * edge;
  const Interval distance = Interval(reach.gap) / half;
  const double singular = (distance + sqrt(Interval(1) + square(distance))).lower;
  const double rho = 1 + (singular - 1) * n / (n + 2.0);  // any number between is right
  if (!(rho > 1 && rho < singular)) return certain_analytic_truncation(n, 1);
  const Interval semi_axis = Interval(0.5) * (Interval(rho) + Interval(1) / rho);
  const Interval clearance =
      half * Interval(0.5) * (Interval(singular) - rho) * (Interval(1) - Interval(1) / (Interval(singular) * rho));
  const Interval kernel = reach.numerator * square(semi_axis) / square(square(clearance));
  return (kernel * certain_analytic_truncation(n, rho)).upper;
}

struct Plan {
  std::array<int, 4> nodes{};
  double truncation = 0;
  double evaluations = 1;
};

std::optional<Plan> plan(const Reach& reach, const std::array<double, 4>& edges, double goal, double budget) {
  Plan result;
  for (std::size_t v = 0; v < edges.size(); ++v) {
    int n = 2;
    double truncation = 0;
    for (;; ++n) {
      // Of a variable in [0, 1] half the rule's error counts; the kernel is twice cos cos / r².
      truncation = one_variable(reach, edges[v], n);
      if (truncation <= 0.25 * goal) break;
      if (n == kMaxGaussNodes || result.evaluations * (n + 1) > budget) return std::nullopt;
    }
    result.nodes[v] = n;
    result.truncation = above(result.truncation + truncation);
    result.evaluations *= n;
  }
  if (!(result.evaluations <= budget)) return std::nullopt;
  return result;
}

struct Sample {
  Interval3 point;
  Interval weight;
};

Interval unit_node(const QuadratureNode& node) {
  return Interval(0.5) * (Interval(1) + Interval(below(node.x), above(node.x)));
}
Interval unit_weight(const QuadratureNode& node) {
  return Interval(0.5) * Interval(below(node.weight), above(node.weight));
}

std::vector<Sample> samples(const Triangle& t, int n_along, int n_across) {
  std::vector<Sample> result;
  for (const QuadratureNode& i : gauss_legendre(n_along)) {
    const Interval s = unit_node(i);
    for (const QuadratureNode& j : gauss_legendre(n_across)) {
      result.push_back({s * (t.along + unit_node(j) * t.across), unit_weight(i) * unit_weight(j) * s});
    }
  }
  return result;
}

double longest(const Interval3& a) {
  return norm(a).upper;
}

Reach reach_of(const Triangle& a, const Triangle& b, const Interval3& offset, double gap) {
  const auto corners = [](const Triangle& t) {
    return std::array<Interval3, 3>{Interval3(), t.along, t.along + t.across};
  };
  Interval above_a, above_b;
  for (const Interval3& p : corners(b)) above_a = max(above_a, abs(dot(a.doubled, offset + p)));
  for (const Interval3& p : corners(a)) above_b = max(above_b, abs(dot(b.doubled, offset - p)));
  return {gap, Interval(above_a.upper) * above_b.upper};
}

Interval sum_of(const std::vector<Sample>& first, const std::vector<Sample>& second, const Interval3& offset,
                const Interval3& normal_1, const Interval3& normal_2) {
  // Heights change with the other triangle's point only: a flat triangle is at no height above itself.
  Interval sum;
  std::vector<Interval> heights;
  for (const Sample& b : second) heights.push_back(dot(normal_1, offset + b.point) * b.weight);
  for (const Sample& a : first) {
    const Interval3 way = offset - a.point;
    Interval inner;
    for (std::size_t j = 0; j < second.size(); ++j) {
      inner = inner + heights[j] / square(square(way + second[j].point));
    }
    sum = sum - a.weight * dot(normal_2, way) * inner;
  }
  return Interval(2) * sum;
}

}  // namespace

std::optional<Interval> enclosed_area(const EnclosedOutline& first, const EnclosedOutline& second, double goal,
                                      std::int64_t budget, std::int64_t& work) {
  const double gap = least_gap(first, second);
  if (!(gap > 0)) return std::nullopt;
  const std::vector<Triangle> from = fan(first), to = fan(second);
  const Interval3 offset = second[0] - first[0];
  const double pairs = static_cast<double>(from.size() * to.size());
  std::vector<Plan> plans;
  for (const Triangle& a : from) {
    for (const Triangle& b : to) {
      const std::array<double, 4> edges{std::max(longest(a.along), longest(a.along + a.across)), longest(a.across),
                                        std::max(longest(b.along), longest(b.along + b.across)), longest(b.across)};
      const auto chosen = plan(reach_of(a, b, offset, gap), edges, goal / pairs, static_cast<double>(budget) / pairs);
      if (!chosen) return std::nullopt;
      plans.push_back(*chosen);
    }
  }
  Interval total;
  std::size_t next = 0;
  for (const Triangle& a : from) {
    for (const Triangle& b : to) {
      const Plan& p = plans[next++];
      total = total + sum_of(samples(a, p.nodes[0], p.nodes[1]), samples(b, p.nodes[2], p.nodes[3]), offset, a.doubled,
                             b.doubled);
      total = total + Interval(-p.truncation, p.truncation);
      work += static_cast<std::int64_t>(p.evaluations);
    }
  }
  return total;
}

}  // namespace etendue
