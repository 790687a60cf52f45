// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "etendue/core/double_double.hpp"

namespace etendue {

/// A double that is certainly not above, or not below, the exact result that rounding to nearest made `value` of:
/// at most the neighbour of the neighbour. No change of the rounding mode, no assembler, valid at any optimisation.
///
/// Domain    any value but NaN; a result that overflowed is moved to infinity, or to the largest double
/// Accuracy  proved: NOTES.md §1
/// Source    Rump, Zimmermann, Boldo and Melquiond 2009, Computing predecessor and successor in rounding to nearest
inline double outward_step(double value) {
  constexpr double kJustAboveUnit = 0x1.0000000000001p-53;  // u (1 + 2u)
  return kJustAboveUnit * std::abs(value) + std::numeric_limits<double>::denorm_min();
}
inline double below(double value) {
  const double moved = value - outward_step(value);
  return moved == moved ? moved : std::numeric_limits<double>::max();  // only ∞ − ∞ is not a number
}
inline double above(double value) {
  const double moved = value + outward_step(value);
  return moved == moved ? moved : std::numeric_limits<double>::lowest();
}

/// All real numbers between two doubles, both included. Every function below returns an interval that contains the
/// exact result for every choice of real numbers from its arguments; a bound is infinite where it is not known.
///
/// Accuracy  inclusion proved, NOTES.md; each bound of +, −, ·, /, sqrt within two units in the last place of the
///           tightest one, − and + tight where the result is a double; log, atan: kElementaryError
/// Errors    none: an argument outside a function's domain counts as far as it lies inside
struct Interval {
  double lower = 0;
  double upper = 0;

  Interval() = default;
  Interval(double value) : lower(value), upper(value) {}
  Interval(double low, double high) : lower(low), upper(high) {}

  static Interval everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  bool contains(double value) const { return lower <= value && value <= upper; }
  bool contains(const Interval& other) const { return lower <= other.lower && other.upper <= upper; }
  bool is_zero() const { return lower == 0 && upper == 0; }
  bool certainly_positive() const { return lower > 0; }
  bool certainly_negative() const { return upper < 0; }
  /// Of about the middle, a number within; of the unbounded, anything finite.
  double middle() const {
    const double half = 0.5 * lower + 0.5 * upper;
    return std::isfinite(half) ? std::clamp(half, lower, upper) : std::clamp(0.0, lower, upper);
  }
  /// Upper bound on the distance of the bounds.
  double width() const { return upper > lower ? above(upper - lower) : 0; }
  /// Largest absolute value, least absolute value.
  double magnitude() const { return std::max(std::abs(lower), std::abs(upper)); }
  double mignitude() const { return contains(0.0) ? 0 : std::min(std::abs(lower), std::abs(upper)); }
};

/// Bound on the relative error, in units of u, of the logarithm and the arc tangent of one double before they are
/// rounded outward; proved, NOTES.md §2.
inline constexpr double kElementaryError = 10;

inline Interval operator-(const Interval& a) {
  return {-a.upper, -a.lower};
}

inline Interval operator+(const Interval& a, const Interval& b) {
  // The exact error of a sum says whether it was rounded the wrong way. NaN, after an overflow, counts as unknown.
  const DoubleDouble low = exact_sum(a.lower, b.lower), high = exact_sum(a.upper, b.upper);
  return {low.low >= 0 ? low.high : below(low.high), high.low <= 0 ? high.high : above(high.high)};
}

inline Interval operator-(const Interval& a, const Interval& b) {
  return a + (-b);
}

Interval unordinary_product(const Interval& a, const Interval& b);

inline Interval operator*(const Interval& a, const Interval& b) {
  if (a.is_zero() || b.is_zero()) return {};
  const double ll = a.lower * b.lower, lu = a.lower * b.upper, ul = a.upper * b.lower, uu = a.upper * b.upper;
  const double sum = (ll + lu) + (ul + uu);
  if (!(std::abs(sum) <= std::numeric_limits<double>::max())) return unordinary_product(a, b);
  return {below(std::min(std::min(ll, lu), std::min(ul, uu))), above(std::max(std::max(ll, lu), std::max(ul, uu)))};
}

/// Everything where b contains zero.
[[nodiscard]] Interval operator/(const Interval& a, const Interval& b);

/// x², never below zero.
[[nodiscard]] inline Interval square(const Interval& a) {
  const double low = a.mignitude(), high = a.magnitude();
  return {std::max(0.0, below(low * low)), high == 0 ? 0 : above(high * high)};
}

/// Of the part ≥ 0.
[[nodiscard]] inline Interval sqrt(const Interval& a) {
  const double high = std::sqrt(std::max(0.0, a.upper));
  return {std::max(0.0, below(std::sqrt(std::max(0.0, a.lower)))), high == 0 ? 0 : above(high)};
}

/// Natural logarithm of the part > 0; −∞ below where that reaches 0. Rests on no library function.
[[nodiscard]] Interval log(const Interval& a);

/// Rests on no library function.
[[nodiscard]] Interval atan(const Interval& a);

/// The angle in [0, π] of the direction (x, y) with y ≥ 0; what y has below zero is ignored.
[[nodiscard]] Interval angle(const Interval& y, const Interval& x);

[[nodiscard]] inline Interval pi() {
  return {0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};
}

[[nodiscard]] inline Interval abs(const Interval& a) {
  return {a.mignitude(), a.magnitude()};
}

/// Least interval that contains both.
[[nodiscard]] inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

[[nodiscard]] inline Interval min(const Interval& a, const Interval& b) {
  return {std::min(a.lower, b.lower), std::min(a.upper, b.upper)};
}

[[nodiscard]] inline Interval max(const Interval& a, const Interval& b) {
  return {std::max(a.lower, b.lower), std::max(a.upper, b.upper)};
}

}  // namespace etendue
