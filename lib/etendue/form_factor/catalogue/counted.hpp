// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/bounded.hpp"
#include "etendue/core/double_double.hpp"

namespace etendue::catalogue {

/// A real number, known within `error` of `value`: the arithmetic in which the catalogue's formulas stand.
///
/// Closed forms cancel: C-11 is of order x²y² with terms of order one. So every formula is evaluated in twice the digits
/// of double, and every operation counts what it may have lost; the bound that comes out is proved, cancellation and
/// all, and says where a formula is of no use.
///
///     |truth − value| ≤ error                                                              form_factor/NOTES.md §9
///
/// Domain    magnitudes between 2^-900 and 2^900, or zero; smaller products are counted as lost
/// Accuracy  proved: each operation adds the propagated errors, its own rounding (kDoubleDoubleError, and kFunctionError
///           for the elementary functions), and the rounding of the count itself (kCountSlack)
struct Counted {
  DoubleDouble value;
  double error = 0;

  Counted() = default;
  Counted(double exact) : value(exact) {}  // NOLINT(google-explicit-constructor): doubles are exact
  Counted(const DoubleDouble& v, double e) : value(v), error(e) {}
};

/// Relative error of log, log1p, atan and the sines below, as operations on exact arguments: kDoubleDoubleFunctionError
/// for those of core; series of our own end below 2^-106, with at most 60 operations of 2^-102, damped by their factors.
inline constexpr double kFunctionError = 0x1p-96;

[[nodiscard]] Counted operator-(const Counted& a);
[[nodiscard]] Counted operator+(const Counted& a, const Counted& b);
[[nodiscard]] Counted operator-(const Counted& a, const Counted& b);
[[nodiscard]] Counted operator*(const Counted& a, const Counted& b);
/// The error is infinite where b may be zero.
[[nodiscard]] Counted operator/(const Counted& a, const Counted& b);

/// Of a number that is not negative; where its value is below zero by rounding, zero within the error.
[[nodiscard]] Counted sqrt(const Counted& a);
[[nodiscard]] Counted square(const Counted& a);
/// Natural logarithms; log1p keeps its relative accuracy at small arguments.
[[nodiscard]] Counted log(const Counted& a);
[[nodiscard]] Counted log1p(const Counted& a);
/// In (−π/2, π/2); atan2 in [0, π] for y ≥ 0 (zero within its error), in (−π, 0) for y < 0.
[[nodiscard]] Counted atan(const Counted& a);
[[nodiscard]] Counted atan2(const Counted& y, const Counted& x);
/// Of arguments in [−1, 1], which their errors may leave.
[[nodiscard]] Counted asin(const Counted& a);
[[nodiscard]] Counted acos(const Counted& a);

/// Sine and cosine of an angle that is exact in degrees, |angle| ≤ 360: exact at every multiple of 90.
[[nodiscard]] Counted sin_deg(double degrees);
[[nodiscard]] Counted cos_deg(double degrees);
/// The angle in radians.
[[nodiscard]] Counted radians(double degrees);
[[nodiscard]] Counted pi();
/// tan(π/n), n ≥ 3.
[[nodiscard]] Counted tan_pi_over(int n);

/// √(1 + x²) − 1 and √(a² + b²), without cancellation or detour.
[[nodiscard]] Counted root1p(const Counted& x);
[[nodiscard]] Counted hypot(const Counted& a, const Counted& b);

/// Rounded to double, the rounding counted.
[[nodiscard]] Bounded bounded(const Counted& a);

}  // namespace etendue::catalogue
