// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace etendue::oracle {

/// Twelve digits are judged: a wider significand than double's keeps the sums' rounding out of them.
using Wide = long double;
static_assert(std::numeric_limits<Wide>::digits >= 64, "the oracle needs more digits than what it judges");

inline constexpr Wide kWidePi = 3.14159265358979323846264338327950288L;

/// Tanh-sinh nodes on (0, 1): doubly exponentially dense at both ends, so that end-point singularities do not matter.
struct DoubleExponentialNode {
  Wide x;       ///< from the left end
  Wide weight;  ///< sums to one
};

inline std::vector<DoubleExponentialNode> double_exponential_nodes(int per_unit) {
  constexpr Wide kReach = 3.9L;  // weights beyond are below 1e-31
  std::vector<DoubleExponentialNode> nodes;
  const int n = static_cast<int>(kReach * static_cast<Wide>(per_unit));
  for (int k = -n; k <= n; ++k) {
    const Wide t = static_cast<Wide>(k) / static_cast<Wide>(per_unit), s = kWidePi / 2 * std::sinh(t);
    const Wide c = std::cosh(s);
    nodes.push_back({1 / (1 + std::exp(-2 * s)), kWidePi / 4 * std::cosh(t) / (c * c) / static_cast<Wide>(per_unit)});
  }
  return nodes;
}

/// ∫ f from low to high.
template <class F>
Wide integrate(const std::vector<DoubleExponentialNode>& nodes, Wide low, Wide high, const F& f) {
  Wide sum = 0;
  const Wide length = high - low;
  for (const auto& node : nodes) sum += node.weight * f(low + length * node.x);
  return length * sum;
}

/// Enough for two dimensions, and for three.
inline const std::vector<DoubleExponentialNode>& fine_nodes() {
  static const std::vector<DoubleExponentialNode> nodes = double_exponential_nodes(22);
  return nodes;
}
inline const std::vector<DoubleExponentialNode>& coarse_nodes() {
  static const std::vector<DoubleExponentialNode> nodes = double_exponential_nodes(12);
  return nodes;
}

template <class F>
Wide integrate(Wide low, Wide high, const F& f) {
  return high > low ? integrate(fine_nodes(), low, high, f) : Wide(0);
}
template <class F>
Wide integrate_coarse(Wide low, Wide high, const F& f) {
  return high > low ? integrate(coarse_nodes(), low, high, f) : Wide(0);
}

/// ∫ over a period: the trapezoidal rule converges geometrically.
template <class F>
Wide integrate_period(int n, const F& f) {
  Wide sum = 0;
  for (int k = 0; k < n; ++k) sum += f(2 * kWidePi * (static_cast<Wide>(k) + 0.5L) / static_cast<Wide>(n));
  return sum * 2 * kWidePi / static_cast<Wide>(n);
}

struct WideVector {
  Wide x, y, z;
};
inline WideVector operator+(const WideVector& a, const WideVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline WideVector operator-(const WideVector& a, const WideVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline WideVector operator*(Wide k, const WideVector& a) {
  return {k * a.x, k * a.y, k * a.z};
}
inline Wide dot(const WideVector& a, const WideVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// cos a_1 cos a_2/(π r²), the kernel of every form factor; negative cosines are the caller's concern.
inline Wide kernel(const WideVector& from, const WideVector& normal, const WideVector& to, const WideVector& facing) {
  const WideVector r = to - from;
  const Wide square = dot(r, r);
  return -dot(normal, r) * dot(facing, r) / (kWidePi * square * square);
}

/// The same between strips that are infinitely long in y: ½ cos a_1 cos a_2/r.
inline Wide kernel_of_strips(const WideVector& from, const WideVector& normal, const WideVector& to,
                             const WideVector& facing) {
  const WideVector r = to - from;
  const Wide square = dot(r, r);
  return -dot(normal, r) * dot(facing, r) / (2 * square * std::sqrt(square));
}

}  // namespace etendue::oracle
