// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/cell_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

constexpr std::size_t kMost = 17;

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

/// Over the quadrilateral c0 c1 c2 c3; a triangle repeats its first corner, on which the rule then collapses.
void add(ShadowView& view, Integrand integrand, const Vec2& c0, const Vec2& c1, const Vec2& c2, const Vec2& c3,
         const Rule& rule, CellSum& sum) {
  const auto want = integrand == Integrand::hidden ? ShadowView::Want::hidden : ShadowView::Want::both;
  const Vec2 du = c1 - c0, dv = c3 - c0, duv = c2 - c1 - c3 + c0;
  std::array<double, kMost> across{};
  std::array<double, 2> tails{};
  for (std::size_t i = 0; i < rule.n; ++i) {
    double along = 0;
    for (std::size_t j = 0; j < rule.n; ++j) {
      const double u = rule.x[i], v = rule.x[j];
      const Vec2 along_u = du + v * duv, along_v = dv + u * duv;
      const double jacobian = std::abs(along_u.x() * along_v.y() - along_u.y() * along_v.x());
      const ShadowView::Seen seen = view.from(c0 + u * along_u + v * dv, want);
      const double f = integrand == Integrand::hidden ? seen.hidden : seen.free - seen.hidden;
      const double density = jacobian * f;
      sum.value += rule.weight[i] * rule.weight[j] * density;
      along += rule.top[j] * density;
      across[j] += rule.top[i] * density;
      sum.low = std::min(sum.low, f);
      sum.high = std::max(sum.high, f);
    }
    tails[1] = std::max(tails[1], std::abs(along));
  }
  for (std::size_t j = 0; j < rule.n; ++j) tails[0] = std::max(tails[0], std::abs(across[j]));
  sum.tail += std::max(tails[0], tails[1]);
  sum.tails = tails;
  sum.evaluations += static_cast<int>(rule.n * rule.n);
}

/// The corner of the cell that a point comes near, compared with the cell's size; or −1.
int singular_corner(const Cell& cell, std::span<const Vec3> near) {
  constexpr double kNear = 0.25;
  double least = kNear * kNear * cell.longest().squaredNorm();
  int corner = -1;
  for (const Vec3& p : near) {
    if (p.z() * p.z() >= least) continue;
    for (int i = 0; i < cell.size(); ++i) {
      const double square = (cell[i] - p.head<2>()).squaredNorm() + p.z() * p.z();
      if (square >= least) continue;
      least = square;
      corner = i;
    }
  }
  return corner;
}

}  // namespace

CellSum integrate(ShadowView& view, Integrand integrand, const Cell& cell, std::span<const Vec3> near, int n) {
  CellSum sum;
  const Rule& rule = rule_of(n);
  const int apex = singular_corner(cell, near), size = cell.size();
  const auto corner = [&](int i) -> const Vec2& { return cell[(std::max(apex, 0) + i) % size]; };
  if (apex >= 0) {
    for (int i = 1; i + 1 < size; ++i) add(view, integrand, corner(0), corner(i), corner(i + 1), corner(0), rule, sum);
    sum.tails = {};
    return sum;
  }
  for (int i = 1; i + 1 < size; i += 2) {
    add(view, integrand, corner(0), corner(i), corner(i + 1), corner(i + 2 < size ? i + 2 : 0), rule, sum);
  }
  if (size != 4) sum.tails = {};
  return sum;
}

}  // namespace etendue
