// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/cell_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

constexpr std::size_t kMost = 17;

/// Nearer to a corner than this share of the way to the centre, coordinates have no digits left to tell points apart.
constexpr double kNearestLook = 0x1p-40;

/// A Gauss rule with what reads off the coefficient of the Legendre polynomial of degree n − 1.
struct Rule {
  std::size_t n = 0;
  std::array<double, kMost> x{}, weight{}, top{};  ///< on [0, 1]
};

double legendre(int degree, double x) {
  double before = 1, value = x;
  if (degree == 0) return 1;
  for (int k = 1; k < degree; ++k) {
    const double next = ((2 * k + 1) * x * value - k * before) / (k + 1);
    before = value;
    value = next;
  }
  return value;
}

const Rule& rule_of(int n) {
  static const std::array<Rule, kMost + 1> rules = [] {
    std::array<Rule, kMost + 1> made;
    for (std::size_t k = 1; k <= kMost; ++k) {
      const int degree = static_cast<int>(k) - 1;
      const auto nodes = gauss_legendre(static_cast<int>(k));
      made[k].n = k;
      for (std::size_t i = 0; i < k; ++i) {
        made[k].x[i] = 0.5 * (1 + nodes[i].x);
        made[k].weight[i] = 0.5 * nodes[i].weight;
        made[k].top[i] = (2 * degree + 1) * 0.5 * nodes[i].weight * legendre(degree, nodes[i].x);
      }
    }
    return made;
  }();
  return rules[static_cast<std::size_t>(n)];
}

/// The nodes of a quadrilateral, and by how much the area stretches there.
struct Nodes {
  std::array<Vec2, kMost * kMost> point;
  std::array<double, kMost * kMost> jacobian, factor;
};

/// Over the quadrilateral c0 c1 c2 c3; a triangle repeats its first corner, on which the rule then collapses.
void add(const CellView& view, const Vec2& c0, const Vec2& c1, const Vec2& c2, const Vec2& c3, const Rule& rule,
         CellSum& sum) {
  const Vec2 du = c1 - c0, dv = c3 - c0, duv = c2 - c1 - c3 + c0;
  const std::size_t n = rule.n;
  Nodes nodes;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double u = rule.x[i], v = rule.x[j];
      const Vec2 along_u = du + v * duv, along_v = dv + u * duv;
      nodes.jacobian[i * n + j] = std::abs(along_u.x() * along_v.y() - along_u.y() * along_v.x());
      nodes.point[i * n + j] = c0 + u * along_u + v * dv;
    }
  }
  view.look({nodes.point.data(), n * n}, {nodes.factor.data(), n * n});
  std::array<double, kMost> across{};
  std::array<double, 2> tails{};
  for (std::size_t i = 0; i < n; ++i) {
    double along = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double f = nodes.factor[i * n + j], density = nodes.jacobian[i * n + j] * f;
      sum.value += rule.weight[i] * rule.weight[j] * density;
      along += rule.top[j] * density;
      across[j] += rule.top[i] * density;
      sum.low = std::min(sum.low, f);
      sum.high = std::max(sum.high, f);
    }
    tails[1] = std::max(tails[1], std::abs(along));
  }
  for (std::size_t j = 0; j < n; ++j) tails[0] = std::max(tails[0], std::abs(across[j]));
  sum.tail += std::max(tails[0], tails[1]);
  sum.tails = tails;
  sum.evaluations += static_cast<int>(n * n);
}

/// The corners of the cell that points come near, compared with the cell's size, and the nearest of all, or −1.
struct NearCorners {
  unsigned bits = 0;
  int nearest = -1;
};

NearCorners near_corners(const Cell& cell, std::span<const Vec3> near) {
  constexpr double kNear = 0.25;
  const double most = kNear * kNear * cell.longest().squaredNorm();
  double least = most;
  NearCorners found;
  for (const Vec3& p : near) {
    if (p.z() * p.z() >= most) continue;
    double square = most;
    int corner = -1;
    for (int i = 0; i < cell.size(); ++i) {
      const double here = (cell[i] - p.head<2>()).squaredNorm() + p.z() * p.z();
      if (here >= square) continue;
      square = here;
      corner = i;
    }
    if (corner < 0) continue;
    found.bits |= 1u << corner;
    if (square >= least) continue;
    least = square;
    found.nearest = corner;
  }
  return found;
}

/// unseen_at_ends() at one corner.
double unseen_at(const Vec2& corner, const CellView& view, const Cell& cell, double first_node, double least,
                 int& evaluations) {
  struct Look {
    double way, factor;
  };
  const Vec2 way = cell.centre() - corner;
  double missed = 0;
  Look before{}, last{};
  int looks = 0;
  for (double share = 1; share > kNearestLook; share /= 4) {
    const Cell end = cell.cut(way, way.dot(corner + share * way)).below;
    if (end.size() < 3 || !(end.area() > least)) break;
    const Vec2 point = end.centre();
    Look look{way.dot(point - corner), 0};
    view.look({&point, 1}, {&look.factor, 1});
    ++looks;
    if (looks > 2 && share <= first_node) {
      const double slope = (last.factor - before.factor) / (last.way - before.way);
      missed += end.area() * std::abs(look.factor - last.factor - slope * (look.way - last.way));
    }
    before = std::exchange(last, look);
  }
  evaluations += looks;
  return missed;
}

}  // namespace

void CellView::look(std::span<const Vec2> points, std::span<double> factors) const {
  const bool hidden = integrand_ == Integrand::hidden;
  if (!formed_) {
    const auto want = hidden ? ShadowView::Want::hidden : ShadowView::Want::both;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const ShadowView::Seen seen = view_.from(points[k], want);
      factors[k] = hidden ? seen.hidden : seen.free - seen.hidden;
    }
    return;
  }
  std::fill(factors.begin(), factors.end(), 0.0);
  add_factors(view_.edges(), form_, points, factors);
  if (hidden) return;
  for (double& factor : factors) factor = -factor;
  add_factors(view_.edges(), view_.receiver_form(), points, factors);
}

CellSum integrate(const CellView& view, const Cell& cell, std::span<const Vec3> near, int n) {
  CellSum sum;
  const Rule& rule = rule_of(n);
  const NearCorners singular = near_corners(cell, near);
  const int apex = singular.nearest, size = cell.size();
  sum.ends = singular.bits;
  sum.nodes = n;
  const auto corner = [&](int i) -> const Vec2& { return cell[(std::max(apex, 0) + i) % size]; };
  if (apex >= 0) {
    for (int i = 1; i + 1 < size; ++i) add(view, corner(0), corner(i), corner(i + 1), corner(0), rule, sum);
    sum.tails = {};
    return sum;
  }
  for (int i = 1; i + 1 < size; i += 2) {
    add(view, corner(0), corner(i), corner(i + 1), corner(i + 2 < size ? i + 2 : 0), rule, sum);
  }
  if (size != 4) sum.tails = {};
  return sum;
}

double unseen_at_ends(const CellView& view, const Cell& cell, const CellSum& sum, double least, int& evaluations) {
  double missed = 0;
  for (int i = 0; i < cell.size(); ++i) {
    if ((sum.ends >> i & 1u) == 0) continue;
    missed += unseen_at(cell[i], view, cell, 1 + gauss_legendre(sum.nodes).front().x, least, evaluations);
  }
  return missed;
}

}  // namespace etendue
