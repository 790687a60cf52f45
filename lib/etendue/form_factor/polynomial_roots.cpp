// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/polynomial_roots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace etendue {

namespace {

constexpr int kDegree = 4;
/// Enough halvings to come from any interval to the neighbouring double; secant steps end it long before.
constexpr int kMostSteps = 120;

double value_at(const Quartic& p, int degree, double x) {
  double sum = p[static_cast<std::size_t>(degree)];
  for (int k = degree - 1; k >= 0; --k) sum = sum * x + p[static_cast<std::size_t>(k)];
  return sum;
}

/// The zero in (low, high), where the signs at the ends differ: false position after Illinois, halved where that is slow.
double zero_between(const Quartic& p, int degree, double low, double high, double at_low, double at_high) {
  int side = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) break;
    double x = (low * at_high - high * at_low) / (at_high - at_low);
    if (!(low < x && x < high) || step % 4 == 3) x = middle;
    const double at_x = value_at(p, degree, x);
    if (at_x == 0) return x;
    if ((at_x < 0) == (at_low < 0)) {
      low = x;
      at_low = at_x;
      if (side == -1) at_high *= 0.5;
      side = -1;
    } else {
      high = x;
      at_high = at_x;
      if (side == 1) at_low *= 0.5;
      side = 1;
    }
  }
  return 0.5 * (low + high);
}

struct Zeros {
  std::array<double, kDegree> x;
  int count = 0;
};

/// Are all coefficients in Bernstein's basis over [low, high] of one sign? The polynomial lies in their convex hull.
bool keeps_sign(const Quartic& p, int degree, double low, double high) {
  Quartic taylor = p;  // about `low`, in units of the interval
  for (int k = 0; k < degree; ++k) {
    for (int m = degree - 1; m >= k; --m)
      taylor[static_cast<std::size_t>(m)] += low * taylor[static_cast<std::size_t>(m + 1)];
  }
  double scale = 1;
  for (int k = 0; k <= degree; ++k, scale *= high - low) taylor[static_cast<std::size_t>(k)] *= scale;
  // b_j = Σ_k C(j, k)/C(n, k) t_k
  constexpr double kBinomial[kDegree + 1][kDegree + 1] = {
      {1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};
  bool negative = false, positive = false;
  for (int j = 0; j <= degree; ++j) {
    double b = 0;
    for (int k = 0; k <= j; ++k) b += kBinomial[j][k] / kBinomial[degree][k] * taylor[static_cast<std::size_t>(k)];
    (b < 0 ? negative : positive) = true;
  }
  return !(negative && positive);
}

Zeros zeros_of(const Quartic& p, int degree, double low, double high) {
  while (degree > 0 && p[static_cast<std::size_t>(degree)] == 0) --degree;
  if (degree == 0 || keeps_sign(p, degree, low, high)) return {};
  Zeros turns;
  if (degree > 1) {
    Quartic slope{};
    for (int k = 1; k <= degree; ++k) slope[static_cast<std::size_t>(k - 1)] = k * p[static_cast<std::size_t>(k)];
    turns = zeros_of(slope, degree - 1, low, high);
  }
  Zeros zeros;
  double from = low, at_from = value_at(p, degree, low);
  for (int k = 0; k <= turns.count; ++k) {
    const double to = k < turns.count ? turns.x[static_cast<std::size_t>(k)] : high;
    const double at_to = value_at(p, degree, to);
    if ((at_from < 0) != (at_to < 0) && from < to && zeros.count < degree) {
      const double zero = at_from == 0 ? from : at_to == 0 ? to : zero_between(p, degree, from, to, at_from, at_to);
      if (low < zero && zero < high) zeros.x[static_cast<std::size_t>(zeros.count++)] = zero;
    }
    from = to;
    at_from = at_to;
  }
  return zeros;
}

}  // namespace

void add_sign_changes(const Quartic& polynomial, double low, double high, std::vector<double>& roots) {
  const Zeros zeros = zeros_of(polynomial, kDegree, low, high);
  roots.insert(roots.end(), zeros.x.begin(), zeros.x.begin() + zeros.count);
}

}  // namespace etendue
