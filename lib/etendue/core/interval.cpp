// SPDX-License-Identifier: Apache-2.0
#include "etendue/core/interval.hpp"

#include <array>
#include <cstddef>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// 0 · ∞ = 0: the bound is infinite because it is unknown, the number is not.
double bounded_product(double a, double b) {
  return a == 0 || b == 0 ? 0 : a * b;
}

/// `value` with what kElementaryError leaves open.
Interval widened(double value) {
  const double error = kElementaryError * kUnitRoundoff * std::abs(value);
  return {below(value - error), above(value + error)};
}

constexpr std::size_t kLogTerms = 10, kAtanTerms = 7;
/// 1, 1/3, 1/5 …
constexpr std::array<double, kLogTerms + 1> kOddReciprocals = [] {
  std::array<double, kLogTerms + 1> table{};
  for (std::size_t k = 0; k < table.size(); ++k) table[k] = 1.0 / static_cast<double>(2 * k + 1);
  return table;
}();

/// Logarithm of a finite x > 0, within kElementaryError; the count is in NOTES.md §2.
double approximate_log(double x) {
  constexpr double kSqrtHalf = 0x1.6a09e667f3bcdp-1;
  constexpr double kLn2High = 0x1.62e42feep-1;  // 32 bits: its products with an exponent are exact
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < kSqrtHalf) {
    m *= 2;
    --exponent;
  }
  const double f = m - 1;
  const double s = f / (2 + f);
  const double z = s * s;
  double series = 0;
  for (std::size_t k = kLogTerms; k-- > 0;) series = series * z + kOddReciprocals[k + 1];
  const double mantissa = 2 * s * (1 + z * series);
  return exponent * kLn2High + (mantissa + exponent * kLn2Low);
}

/// Arc tangent of k/8.
constexpr std::array<double, 9> kArcTangents{
    0,
    0x1.fd5ba9aac2f6ep-4,
    0x1.f5b75f92c80ddp-3,
    0x1.6f61941e4def1p-2,
    0x1.dac670561bb4fp-2,
    0x1.1e00babdefeb4p-1,
    0x1.4978fa3269ee1p-1,
    0x1.700a7c5784634p-1,
    0x1.921fb54442d18p-1,
};

/// Arc tangent of 0 ≤ x ≤ 1, within kElementaryError; NOTES.md §2.
double approximate_atan(double x) {
  const double scaled = 8 * x + 0.5;
  const auto k = static_cast<std::size_t>(scaled);
  const double centre = 0.125 * static_cast<double>(k);
  const double t = (x - centre) / (1 + x * centre);
  const double z = t * t;
  double series = 0;
  for (std::size_t j = kAtanTerms; j-- > 0;) series = kOddReciprocals[j] - z * series;
  return kArcTangents[k] + t * series;
}

Interval half_pi() {
  return {0.5 * pi().lower, 0.5 * pi().upper};
}

Interval atan_of(double x) {
  if (x < 0) return -atan_of(-x);
  if (x <= 1) return widened(approximate_atan(x));
  if (x == kInfinity) return half_pi();
  const double low = below(1 / x), high = above(1 / x);
  return half_pi() -
         Interval(widened(approximate_atan(low)).lower, widened(approximate_atan(std::min(high, 1.0))).upper);
}

Interval log_of(double x) {
  if (x <= 0) return {-kInfinity, -kInfinity};
  if (x == kInfinity) return {kInfinity, kInfinity};
  return x == 1 ? Interval() : widened(approximate_log(x));
}

/// Up to this relative width the slope at one end bounds the other end tightly enough, and saves a function.
constexpr double kNarrow = 0x1p-30;

}  // namespace

Interval unordinary_product(const Interval& a, const Interval& b) {
  const std::array<double, 4> p{bounded_product(a.lower, b.lower), bounded_product(a.lower, b.upper),
                                bounded_product(a.upper, b.lower), bounded_product(a.upper, b.upper)};
  return {below(std::min({p[0], p[1], p[2], p[3]})), above(std::max({p[0], p[1], p[2], p[3]}))};
}

Interval operator/(const Interval& a, const Interval& b) {
  if (b.contains(0.0)) return Interval::everything();
  if (a.is_zero()) return {};
  const double ll = a.lower / b.lower, lu = a.lower / b.upper, ul = a.upper / b.lower, uu = a.upper / b.upper;
  if (!(std::abs((ll + lu) + (ul + uu)) <= std::numeric_limits<double>::max())) {
    // Overflow, or infinite bounds: the reciprocal is finite or 0, the product knows how to go on.
    const double low = below(1 / b.upper), high = above(1 / b.lower);
    return unordinary_product(a, {std::min(low, high), std::max(low, high)});
  }
  return {below(std::min(std::min(ll, lu), std::min(ul, uu))), above(std::max(std::max(ll, lu), std::max(ul, uu)))};
}

Interval log(const Interval& a) {
  const Interval low = log_of(a.lower);
  const double width = a.upper - a.lower;
  if (a.lower > 0 && width <= kNarrow * a.lower) {
    // d log x ≤ dx / lower
    return {low.lower, above(low.upper + above(above(width) / a.lower))};
  }
  return {low.lower, log_of(a.upper).upper};
}

Interval atan(const Interval& a) {
  const Interval low = atan_of(a.lower);
  const double width = a.upper - a.lower;
  // d atan x ≤ dx
  if (width <= kNarrow * a.mignitude() && a.magnitude() <= 1) return {low.lower, above(low.upper + above(width))};
  return {low.lower, atan_of(a.upper).upper};
}

Interval angle(const Interval& y, const Interval& x) {
  const Interval height(std::max(0.0, y.lower), std::max(0.0, y.upper));
  const double side = x.magnitude();
  Interval turn;
  if (height.lower > 0 && height.lower >= side) {
    turn = half_pi() - atan(x / height);
  } else if (x.lower > 0) {
    turn = atan(height / x);
  } else if (x.upper < 0) {
    turn = pi() - atan(height / (-x));
  } else if (height.lower > 0) {
    // The angle falls with x; it rises with y where x > 0 and falls where x < 0.
    const Interval right = x.upper / Interval(height.lower), left = x.lower / Interval(height.lower);
    turn = half_pi() - Interval(atan(left).lower, atan(right).upper);
  } else {
    turn = {0, pi().upper};
  }
  return {std::max(0.0, turn.lower), std::min(pi().upper, turn.upper)};
}

}  // namespace etendue
