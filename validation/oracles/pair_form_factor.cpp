// SPDX-License-Identifier: Apache-2.0
#include "oracles/pair_form_factor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "oracles/ball.hpp"

namespace etendue::oracle {

namespace {

struct Vector {
  Ball x, y, z;
};

Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator*(const Ball& k, const Vector& a) {
  return {k * a.x, k * a.y, k * a.z};
}
Ball dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Loop = std::vector<Vector>;

Loop exact(const std::vector<Point>& points) {
  Loop loop;
  for (const Point& p : points) loop.push_back({Ball(p[0]), Ball(p[1]), Ball(p[2])});
  return loop;
}

Vector area_vector(const Loop& loop) {
  Vector sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum = sum + cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  return Ball(0.5) * sum;
}

Loop in_front(const Loop& loop, const Loop& plane, double planarity, double& margin) {
  const Vector area = area_vector(plane);
  const Ball size = sqrt(dot(area, area));
  const double extent = std::sqrt(size.midpoint());
  std::vector<Ball> heights;
  bool any = false;
  for (const Vector& v : loop) {
    const Vector r = v - plane[0];
    Ball height = dot(r, area) / size;
    const double relative = std::abs(height.midpoint()) / std::max(extent, std::sqrt(dot(r, r).midpoint()));
    if (relative <= planarity) {
      height = Ball(0);
    } else {
      margin = std::min(margin, relative);
    }
    any = any || height.certainly_positive();
    heights.push_back(height);
  }
  if (!any) return {};
  Loop kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    if (!heights[i].certainly_negative()) kept.push_back(loop[i]);
    const bool crosses = (heights[i].certainly_positive() && heights[j].certainly_negative()) ||
                         (heights[i].certainly_negative() && heights[j].certainly_positive());
    if (crosses) kept.push_back(loop[i] + heights[i] / (heights[i] - heights[j]) * (loop[j] - loop[i]));
  }
  return kept;
}

struct Node {
  Ball x;       ///< in (0, 1)
  Ball weight;  ///< without the step
};

constexpr int kLevel = 32;  // steps per unit of the transformed variable; the check uses every other one
constexpr int kReach = 5;   // the rule's weights there are below 1e-90
constexpr double kNothing = 0x1p-400;

const std::vector<Node>& nodes() {
  static const std::vector<Node> table = [] {
    std::vector<Node> result;
    for (int k = -kReach * kLevel; k <= kReach * kLevel; ++k) {
      const Ball t(static_cast<double>(k) / kLevel), half(0.5);
      const Ball inner = half * pi() * sinh(t);
      const Ball denominator = exp(inner) + exp(-inner);
      const Ball c = cosh(inner);
      result.push_back({exp(inner) / denominator, half * half * pi() * cosh(t) / (c * c)});
    }
    return result;
  }();
  return table;
}

/// ∫ over the edge from `start` to `end` of ln |x − p|.
Ball inner_integral(const Vector& p, const Vector& start, const Vector& end) {
  const Vector edge = end - start, a = start - p, b = end - p;
  const Ball length = sqrt(dot(edge, edge));
  const Ball x0 = dot(a, edge) / length, x1 = dot(b, edge) / length;
  const Ball r0 = dot(a, a), r1 = dot(b, b), half(0.5);
  Ball sum = -length;
  if (r1.midpoint() > kNothing) sum = sum + half * x1 * log(r1);
  if (r0.midpoint() > kNothing) sum = sum - half * x0 * log(r0);
  const Vector area = cross(a, edge);
  const Ball square = dot(area, area);
  if (square.midpoint() > kNothing) {
    const Ball h = sqrt(square) / length;
    sum = sum + h * (atan(x1 / h) - atan(x0 / h));
  }
  return sum;
}

/// Where along a–b (in [0, 1]) the integrand has its singularities nearest.
std::vector<Ball> breaks(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector u = b - a, v = d - c, w = c - a;
  std::vector<Ball> cuts{Ball(0), Ball(1)};
  const auto add = [&](const Ball& t) {
    if (t.certainly_positive() && (Ball(1) - t).certainly_positive()) cuts.push_back(t);
  };
  add(dot(w, u) / dot(u, u));
  add(dot(d - a, u) / dot(u, u));
  const Vector n = cross(u, v);
  const Ball square = dot(n, n);
  if (square.midpoint() > 1e-30 * dot(u, u).midpoint() * dot(v, v).midpoint()) add(dot(cross(w, v), n) / square);
  std::sort(cuts.begin(), cuts.end(), [](const Ball& p, const Ball& q) { return p.midpoint() < q.midpoint(); });
  return cuts;
}

struct TwoLevels {
  Ball fine;
  Ball coarse;
};

void add_pair(const Vector& a, const Vector& b, const Vector& c, const Vector& d, TwoLevels& sum) {
  const Vector u = b - a, v = d - c;
  const Ball cosine_lengths = dot(u, v) / sqrt(dot(v, v));
  if (!cosine_lengths.certainly_positive() && !cosine_lengths.certainly_negative()) return;
  const std::vector<Ball> cuts = breaks(a, b, c, d);
  for (std::size_t piece = 0; piece + 1 < cuts.size(); ++piece) {
    const Ball width = cuts[piece + 1] - cuts[piece];
    const Ball scale = cosine_lengths * width;
    for (std::size_t k = 0; k < nodes().size(); ++k) {
      const Node& node = nodes()[k];
      const Ball s = cuts[piece] + width * node.x;
      const Ball term = scale * node.weight * inner_integral(a + s * u, c, d);
      sum.fine = sum.fine + term / Ball(kLevel);
      if (k % 2 == 0) sum.coarse = sum.coarse + term / Ball(kLevel / 2);
    }
  }
}

}  // namespace

PairFormFactor pair_form_factor(const std::vector<Point>& from, const std::vector<Point>& to, double planarity) {
  const Loop whole_1 = exact(from), whole_2 = exact(to);
  PairFormFactor result;
  result.margin = 1;
  const Loop second = in_front(whole_2, whole_1, planarity, result.margin);
  const Loop first = in_front(whole_1, whole_2, planarity, result.margin);
  if (first.size() < 3 || second.size() < 3) return result;
  TwoLevels sum;
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; j < second.size(); ++j) {
      add_pair(first[i], first[(i + 1) % first.size()], second[j], second[(j + 1) % second.size()], sum);
    }
  }
  const Vector area = area_vector(whole_1);
  const Ball scale = Ball(2) * pi() * sqrt(dot(area, area));
  result.factor = (sum.fine / scale).midpoint();
  result.estimate = std::abs(((sum.fine - sum.coarse) / sum.fine).midpoint());
  return result;
}

}  // namespace etendue::oracle
