// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/aligned_rule.hpp"

#include <array>
#include <numbers>

#include "etendue/form_factor/difference_rule.hpp"

namespace etendue {

namespace {

using namespace aligned;

/// Nodes of the rules for ∫∫ f(x − y) dx dy over [−1, 1]²: those of gauss_difference(), or all pairs of Gauss-Legendre.
struct DifferenceNodes {
  static constexpr std::size_t kMost = kMostProductNodes * kMostProductNodes;
  std::size_t count = 0;
  std::array<double, kMost> x{}, y{}, weight{};
};

DifferenceNodes difference_nodes(int n, bool equal) {
  DifferenceNodes nodes;
  const auto add = [&nodes](double x, double y, double weight) {
    nodes.x[nodes.count] = x;
    nodes.y[nodes.count] = y;
    nodes.weight[nodes.count++] = weight;
  };
  if (equal) {
    for (const QuadratureNode& w : gauss_difference(n)) add(w.x, 0, w.weight);
  } else {
    for (const QuadratureNode& a : gauss_legendre(n)) {
      for (const QuadratureNode& b : gauss_legendre(n)) add(a.x, b.x, a.weight * b.weight);
    }
  }
  return nodes;
}

struct NodeTables {
  std::array<DifferenceNodes, kRules> equal;
  std::array<DifferenceNodes, kMostProductNodes - kLeastNodes + 1> unequal;
};

const DifferenceNodes& tabulated_nodes(int n, bool equal) {
  static const NodeTables tables = [] {
    NodeTables made;
    for (std::size_t i = 0; i < made.equal.size(); ++i)
      made.equal[i] = difference_nodes(static_cast<int>(i) + kLeastNodes, true);
    for (std::size_t i = 0; i < made.unequal.size(); ++i)
      made.unequal[i] = difference_nodes(static_cast<int>(i) + kLeastNodes, false);
    return made;
  }();
  const auto i = static_cast<std::size_t>(n - kLeastNodes);
  return equal ? tables.equal[i] : tables.unequal[i];
}

/// Along the common direction, of ∫∫ αβ/r⁴ = ½ atanh(product/(ad + bc)) over the two others, up to constants.
[[gnu::always_inline]] inline void sum_perpendicular(AlignedLanes& in, const DifferenceNodes& nodes, int terms) {
  std::array<double, kMostTerms> coefficients;
  for (int k = 0; k < terms; ++k) coefficients[static_cast<std::size_t>(k)] = 1.0 / (2 * k + 1);
  Lanes total{};
  for (std::size_t k = 0; k < nodes.count; ++k) {
    Lanes argument, square, series;
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double u = in.u[l] + (nodes.y[k] * in.second[l] - nodes.x[k] * in.first[l]), uu = u * u;
      const double ad = (uu + in.squares[0][l]) * (uu + in.squares[3][l]);
      const double bc = (uu + in.squares[1][l]) * (uu + in.squares[2][l]);
      argument[l] = in.product[l] / (ad + bc);
      square[l] = argument[l] * argument[l];
      series[l] = coefficients[static_cast<std::size_t>(terms - 1)];
    }
    for (int term = terms - 2; term >= 0; --term) {
      const double coefficient = coefficients[static_cast<std::size_t>(term)];
      for (std::size_t l = 0; l < kLanes; ++l) series[l] = series[l] * square[l] + coefficient;
    }
    for (std::size_t l = 0; l < kLanes; ++l) total[l] += nodes.weight[k] * (argument[l] * series[l]);
  }
  for (std::size_t l = 0; l < kLanes; ++l) in.total[l] = total[l] * in.factor[l];
}

[[gnu::always_inline]] inline void sum_opposite(AlignedLanes& in, int n_first, int n_second) {
  std::array<Lanes, kMostDifferenceNodes> squares;
  const auto second = gauss_difference(n_second);
  for (std::size_t k = 0; k < second.size(); ++k) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double v = in.v[l] - second[k].x * in.second[l];
      squares[k][l] = v * v;
    }
  }
  Lanes total{};
  for (const QuadratureNode& node : gauss_difference(n_first)) {
    Lanes base, inner{};
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double u = in.u[l] - node.x * in.first[l];
      base[l] = in.squares[0][l] + u * u;
    }
    for (std::size_t k = 0; k < second.size(); ++k) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        const double square = base[l] + squares[k][l];
        inner[l] += second[k].weight / (square * square);
      }
    }
    for (std::size_t l = 0; l < kLanes; ++l) total[l] += node.weight * inner[l];
  }
  for (std::size_t l = 0; l < kLanes; ++l) in.total[l] = total[l] * in.factor[l];
}

[[gnu::always_inline]] inline void sum_lanes(AlignedLanes& in, std::uint32_t key) {
  const int first = kLeastNodes + static_cast<int>(key % kTermsAt);
  if (key >= kOppositeAt) {
    sum_opposite(in, first, kLeastNodes + static_cast<int>((key - kOppositeAt) / kTermsAt));
  } else {
    const bool equal = key >= kEqualAt;
    sum_perpendicular(in, tabulated_nodes(first, equal), kLeastTerms + static_cast<int>(key % kEqualAt / kTermsAt));
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void sum_wide(AlignedLanes& in, std::uint32_t key) {
  sum_lanes(in, key);
}
#else
void sum_wide(AlignedLanes& in, std::uint32_t key) {
  sum_lanes(in, key);
}
#endif

void sum_portable(AlignedLanes& in, std::uint32_t key) {
  sum_lanes(in, key);
}

}  // namespace

void sum_aligned(AlignedLanes& lanes, std::uint32_t key, bool wide) {
  wide ? sum_wide(lanes, key) : sum_portable(lanes, key);
}

}  // namespace etendue
