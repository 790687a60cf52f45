// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/difference_rule.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

using Real = long double;

constexpr std::size_t first_of(int n) {
  return static_cast<std::size_t>(n * (n - 1) / 2);
}

struct Rules {
  std::array<QuadratureNode, first_of(kMostDifferenceNodes + 1)> nodes{};
  std::array<double, kMostDifferenceNodes + 1> remainders{};
};

/// P_(k+1) = x P_k − beta_k P_(k−1), monic and even or odd in turn; norms[k] = ∫ (2 − |w|) P_k².
struct Recurrence {
  std::array<Real, kMostDifferenceNodes + 1> beta{}, norms{};

  struct Value {
    Real value, slope, previous;
  };
  Value at(int n, Real x) const {
    Real previous = 0, value = 1, previous_slope = 0, slope = 0;
    for (int k = 0; k < n; ++k) {
      const Real b = beta[static_cast<std::size_t>(k)];
      const Real next = x * value - b * previous, next_slope = value + x * slope - b * previous_slope;
      previous = value;
      previous_slope = slope;
      value = next;
      slope = next_slope;
    }
    return {value, slope, previous};
  }
};

/// Stieltjes' procedure: beta_k = |P_k|²/|P_(k−1)|². The integrands are polynomials of degree 2n + 1 on [0, 2], and even:
/// the 32-point rule, in twice the digits, makes no error but rounding.
Recurrence compute_recurrence() {
  static_assert(2 * kMostDifferenceNodes + 1 < 2 * kMaxGaussNodes);
  Recurrence recurrence;
  const auto wide = [](const DoubleDouble& x) { return static_cast<Real>(x.high) + static_cast<Real>(x.low); };
  for (int k = 0; k <= kMostDifferenceNodes; ++k) {
    Real norm = 0;
    for (const WideQuadratureNode& node : wide_gauss_legendre(kMaxGaussNodes)) {
      const Real w = 1 + wide(node.x), p = recurrence.at(k, w).value;
      norm += 2 * wide(node.weight) * (2 - w) * p * p;
    }
    const auto i = static_cast<std::size_t>(k);
    recurrence.norms[i] = norm;
    recurrence.beta[i] = k == 0 ? 0 : norm / recurrence.norms[i - 1];
  }
  return recurrence;
}

Rules compute_rules() {
  const Recurrence recurrence = compute_recurrence();
  Rules rules;
  std::vector<Real> roots;  // of P_(n−1); those of P_n lie between them, one each
  for (int n = 1; n <= kMostDifferenceNodes; ++n) {
    std::vector<Real> brackets{-2};
    brackets.insert(brackets.end(), roots.begin(), roots.end());
    brackets.push_back(2);
    roots.clear();
    for (std::size_t i = 0; i + 1 < brackets.size(); ++i) {
      Real low = brackets[i], high = brackets[i + 1];
      const bool rising = recurrence.at(n, high).value > 0;
      constexpr int kHalvings = 8, kNewtonSteps = 8;  // from 2^-8 of the gap Newton's steps are quadratic
      for (int step = 0; step < kHalvings; ++step) {
        const Real middle = (low + high) / 2;
        (recurrence.at(n, middle).value > 0) == rising ? high = middle : low = middle;
      }
      Real x = (low + high) / 2;
      for (int step = 0; step < kNewtonSteps; ++step) {
        const Recurrence::Value p = recurrence.at(n, x);
        x -= p.value / p.slope;
      }
      if (2 * i + 1 == static_cast<std::size_t>(n)) x = 0;
      roots.push_back(x);
      const Recurrence::Value p = recurrence.at(n, x);
      const Real weight = recurrence.norms[static_cast<std::size_t>(n - 1)] / (p.slope * p.previous);
      rules.nodes[first_of(n) + i] = {static_cast<double>(x), static_cast<double>(weight)};
    }
    rules.remainders[static_cast<std::size_t>(n)] = static_cast<double>(recurrence.norms[static_cast<std::size_t>(n)]);
  }
  return rules;
}

const Rules& rules() {
  static const Rules computed = compute_rules();
  return computed;
}

}  // namespace

std::span<const QuadratureNode> gauss_difference(int n) {
  require(n >= 1 && n <= kMostDifferenceNodes, "gauss_difference: 1 <= n <= kMostDifferenceNodes");
  return {rules().nodes.data() + first_of(n), static_cast<std::size_t>(n)};
}

double difference_remainder(int n) {
  require(n >= 1 && n <= kMostDifferenceNodes, "difference_remainder: 1 <= n <= kMostDifferenceNodes");
  return rules().remainders[static_cast<std::size_t>(n)];
}

}  // namespace etendue
