// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/sign_changes.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

constexpr std::size_t kMostDegree = BoundedPolynomial::kMostDegree;
/// Two operations a degree of 2^-102 each on every term, and the magnitude's own rounding: NOTES.md §10.
constexpr double kHorner = 0x1p-98;
/// Each fourth step is a halving: enough of them to come from any interval to neighbouring doubles. Secant steps end it
/// long before, unless the interval is far wider than what curves the polynomial.
constexpr int kHalving = 4;
constexpr int kMostSteps = kHalving * 2100;
/// Newton's steps from a double on double the digits; a second one serves zeros that are nearly double.
constexpr int kNewtonSteps = 2;

struct Value {
  DoubleDouble value;
  double error;

  int sign() const { return value.high > error ? 1 : value.high < -error ? -1 : 0; }
};

Value value_at(const BoundedPolynomial& p, std::size_t degree, const DoubleDouble& x) {
  const double size = std::abs(x.high);
  DoubleDouble sum = p.coefficient[degree];
  double magnitude = std::abs(sum.high), error = p.error[degree];
  for (std::size_t k = degree; k-- > 0;) {
    sum = sum * x + p.coefficient[k];
    magnitude = magnitude * size + std::abs(p.coefficient[k].high);
    error = error * size + p.error[k];
  }
  return {sum, error * (1 + gamma_bound(12)) + kHorner * magnitude};
}

BoundedPolynomial derivative(const BoundedPolynomial& p, std::size_t degree) {
  BoundedPolynomial slope;
  for (std::size_t k = 1; k <= degree; ++k) {
    const auto factor = static_cast<double>(k);
    slope.coefficient[k - 1] = p.coefficient[k] * factor;
    slope.error[k - 1] = (p.error[k] + kHorner * std::abs(p.coefficient[k].high)) * factor;
  }
  return slope;
}

/// An end of a piece on which the polynomial is monotone.
struct End {
  DoubleDouble x;
  double value;
  int sign;
};

End end_at(const BoundedPolynomial& p, std::size_t degree, const DoubleDouble& x) {
  const Value value = value_at(p, degree, x);
  return {x, value.value.high, value.sign()};
}

/// A double near the only zero between two ends of different signs: false position after Illinois, halved where slow.
double bracketed(const BoundedPolynomial& p, std::size_t degree, const End& from, const End& to) {
  double low = from.x.high, high = to.x.high, at_low = from.value, at_high = to.value;
  int side = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const double middle = low + 0.5 * (high - low);
    if (!(low < middle && middle < high)) break;
    double x = low - at_low * ((high - low) / (at_high - at_low));
    if (!(low < x && x < high) || step % kHalving == kHalving - 1) x = middle;
    const double at_x = value_at(p, degree, x).value.high;
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
  return std::abs(at_low) < std::abs(at_high) ? low : high;
}

DoubleDouble clamped(const DoubleDouble& x, const DoubleDouble& low, const DoubleDouble& high) {
  return x < low ? low : high < x ? high : x;
}

/// The least radius (of a geometric series) at which the signs around x are certain and those of the ends.
double proved_error(const BoundedPolynomial& p, std::size_t degree, const DoubleDouble& x, double start,
                    const End& from, const End& to) {
  const double farthest = std::max(rounded(x - from.x), rounded(to.x - x));
  for (double radius = start; radius < farthest; radius *= 4) {
    const DoubleDouble below = x - radius, above = x + radius;
    const bool low_is_right = !(from.x < below) || value_at(p, degree, below).sign() == from.sign;
    const bool high_is_right = !(above < to.x) || value_at(p, degree, above).sign() == to.sign;
    if (low_is_right && high_is_right) return radius;
  }
  return farthest;
}

/// Where the polynomial changes its sign; with a proved error only if that is asked for.
BoundedZero zero_between(const BoundedPolynomial& p, std::size_t degree, const BoundedPolynomial& slope,
                         const End& from, const End& to, bool proved) {
  DoubleDouble x = clamped(bracketed(p, degree, from, to), from.x, to.x);
  double reached = 0;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Value value = value_at(p, degree, x);
    const double steepness = value_at(slope, degree - 1, x).value.high;
    if (steepness == 0) break;
    x = clamped(x - value.value.high / steepness, from.x, to.x);
    reached = 4 * value.error / std::abs(steepness);
  }
  if (!proved) return {x, 0};
  // From below what DoubleDouble can tell apart no search begins.
  const double least = std::max(reached, 0x1p-104 * std::abs(x.high));
  return {x, proved_error(p, degree, x, std::max(least, 0x1p-1000), from, to)};
}

SignChanges changes_of(const BoundedPolynomial& p, std::size_t degree, double low, double high, bool proved) {
  while (degree > 0 && p.coefficient[degree].high == 0 && p.error[degree] == 0) --degree;
  SignChanges changes, turns;
  if (degree == 0) return changes;
  const BoundedPolynomial slope = derivative(p, degree);
  if (degree > 1) turns = changes_of(slope, degree - 1, low, high, false);
  End from = end_at(p, degree, low);
  for (std::size_t k = 0; k <= turns.count; ++k) {
    const End to = end_at(p, degree, k < turns.count ? turns.zero[k].x : DoubleDouble(high));
    // What touches zero belongs to no side: a change is looked for from the last certain sign on.
    if (to.sign == 0 && k < turns.count) continue;
    if (from.sign * to.sign < 0 && changes.count < kMostDegree) {
      changes.zero[changes.count++] = zero_between(p, degree, slope, from, to, proved);
    }
    from = to;
  }
  return changes;
}

}  // namespace

SignChanges sign_changes(const BoundedPolynomial& polynomial, double low, double high) {
  return changes_of(polynomial, kMostDegree, low, high, true);
}

}  // namespace etendue
