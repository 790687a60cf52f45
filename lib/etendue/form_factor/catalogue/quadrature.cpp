// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "etendue/form_factor/catalogue/families.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue::catalogue {

namespace {

struct Node {
  Counted x, weight;
};

/// The rule of double, its nodes made sharp by two steps of Newton's method in twice the digits.
std::vector<Node> sharpened(int n) {
  constexpr double kNodeError = 0x1p-92;  // recurrence of n ≤ 32 steps; what is left of Newton's error is far below
  std::vector<Node> nodes;
  for (const QuadratureNode& node : gauss_legendre(n)) {
    DoubleDouble x(node.x), slope;
    for (int step = 0; step < 3; ++step) {
      DoubleDouble last(1.0), value = x;
      for (int k = 2; k <= n; ++k) {
        const DoubleDouble next = (x * value * (2.0 * k - 1) - last * (k - 1.0)) / DoubleDouble(k);
        last = value;
        value = next;
      }
      slope = (last - x * value) * static_cast<double>(n) / (DoubleDouble(1.0) - x * x);
      if (step < 2) x = x - value / slope;
    }
    const DoubleDouble weight = DoubleDouble(2.0) / ((DoubleDouble(1.0) - x * x) * slope * slope);
    nodes.push_back({Counted(x, kNodeError), Counted(weight, kNodeError)});
  }
  return nodes;
}

Counted sum(const std::vector<Node>& nodes, const Counted& low, const Counted& high,
            Counted (*f)(const Counted&, Values), Values values) {
  const Counted middle = (low + high) / 2, half = (high - low) / 2;
  Counted total;
  for (const Node& node : nodes) total = total + node.weight * f(middle + half * node.x, values);
  return half * total;
}

}  // namespace

Counted integral(const Counted& low, const Counted& high, Counted (*f)(const Counted&, Values), Values values) {
  constexpr int kFine = 30, kCoarse = 24;
  static const std::vector<Node> fine = sharpened(kFine), coarse = sharpened(kCoarse);
  Counted result = sum(fine, low, high, f, values);
  const Counted check = sum(coarse, low, high, f, values) - result;
  result.error += std::abs(check.value.high) + check.error;
  return result;
}

}  // namespace etendue::catalogue
