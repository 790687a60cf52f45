// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/counted.hpp"

#include <cmath>
#include <limits>

#include "etendue/core/contract.hpp"
#include "etendue/core/double_double_functions.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue::catalogue {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// At most eight roundings of double make one count.
constexpr double kCountSlack = 1 + 0x1p-49;
/// Products below this may lose their low parts to underflow.
constexpr double kUnderflow = 0x1p-940;

const DoubleDouble kPi(3.141592653589793116, 1.224646799147353207e-16);

double size(const Counted& a) {
  return std::abs(a.value.high) * (1 + 2 * kUnitRoundoff);
}

Counted with_error(const DoubleDouble& value, double error, double relative = kDoubleDoubleError) {
  return {value, (error + relative * std::abs(value.high)) * kCountSlack};
}

struct SineCosine {
  DoubleDouble sine, cosine;
};

/// Taylor's series for |x| ≤ 0.8: 0.8^28/28! is below 2^-106.
SineCosine sine_cosine(const DoubleDouble& x) {
  constexpr int kTerms = 28;
  DoubleDouble term(1.0);
  SineCosine sum{{}, {1.0}};
  for (int k = 1; k <= kTerms; ++k) {
    term = term * x / DoubleDouble(k);
    const DoubleDouble signed_term = k % 4 < 2 ? term : -term;
    (k % 2 == 0 ? sum.cosine : sum.sine) = (k % 2 == 0 ? sum.cosine : sum.sine) + signed_term;
  }
  return sum;
}

/// In (0, π/2) for x > 0. Below 2^-60 the series' second term is below 2^-120 of the first.
DoubleDouble arc_tangent(const DoubleDouble& x) {
  constexpr double kSame = 0x1p-60;
  return x.high < kSame ? x : angle_of(x, DoubleDouble(1.0));
}

/// 2 artanh(x/(2 + x)): the square of the argument is at most 0.0205 for |x| ≤ ¼.
DoubleDouble logarithm_of_one_plus(const DoubleDouble& x) {
  constexpr int kTerms = 22;
  const DoubleDouble s = x / (DoubleDouble(2.0) + x), s2 = s * s;
  DoubleDouble sum(1.0 / (2 * kTerms + 1));
  for (int k = kTerms - 1; k >= 0; --k) sum = DoubleDouble(1.0) / DoubleDouble(2.0 * k + 1) + s2 * sum;
  return s * sum * 2.0;
}

}  // namespace

Counted operator-(const Counted& a) {
  return {-a.value, a.error};
}

Counted operator+(const Counted& a, const Counted& b) {
  return with_error(a.value + b.value, a.error + b.error);
}

Counted operator-(const Counted& a, const Counted& b) {
  return a + (-b);
}

Counted operator*(const Counted& a, const Counted& b) {
  return with_error(a.value * b.value, size(a) * b.error + size(b) * a.error + a.error * b.error + kUnderflow);
}

Counted operator/(const Counted& a, const Counted& b) {
  const double least = std::abs(b.value.high) * (1 - 2 * kUnitRoundoff) - b.error;
  if (!(least > 0)) return {DoubleDouble(0.0), kInfinite};
  const DoubleDouble quotient = a.value / b.value;
  return with_error(quotient,
                    (a.error + std::abs(quotient.high) * (1 + 2 * kUnitRoundoff) * b.error) / least + kUnderflow);
}

Counted square(const Counted& a) {
  return a * a;
}

Counted sqrt(const Counted& a) {
  const DoubleDouble root = etendue::sqrt(a.value);
  if (a.value.high < -a.error) return {DoubleDouble(0.0), kInfinite};
  if (!(a.value.high > 2 * a.error)) return with_error(root, std::sqrt(std::abs(a.value.high) * 2 + a.error));
  // |√x − √a| = |x − a|/(√x + √a), and √x is not negative.
  return with_error(root, a.error / root.high * (1 + 2 * kUnitRoundoff));
}

Counted log(const Counted& a) {
  const double least = a.value.high * (1 - 2 * kUnitRoundoff) - a.error;
  if (!(least > 0)) return {DoubleDouble(0.0), kInfinite};
  const DoubleDouble value = etendue::log(a.value);
  return with_error(value, a.error / least + kFunctionError, kFunctionError);
}

Counted log1p(const Counted& a) {
  constexpr double kSeries = 0.25;
  if (std::abs(a.value.high) > kSeries) return log(Counted(1.0) + a);
  const double least = (1 + a.value.high) * (1 - 2 * kUnitRoundoff) - a.error;
  if (!(least > 0)) return {DoubleDouble(0.0), kInfinite};
  return with_error(logarithm_of_one_plus(a.value), a.error / least + kUnderflow, kFunctionError);
}

Counted atan(const Counted& a) {
  const double least = std::fmax(0.0, std::abs(a.value.high) * (1 - 2 * kUnitRoundoff) - a.error);
  const double propagated = a.error / (1 + least * least) + kUnderflow;
  const bool negative = a.value.high < 0;
  const DoubleDouble angle = arc_tangent(negative ? -a.value : a.value);
  return with_error(negative ? -angle : angle, propagated, kFunctionError);
}

Counted atan2(const Counted& y, const Counted& x) {
  if (std::abs(x.value.high) < std::abs(y.value.high)) {
    const Counted quarter = pi() * Counted(y.value.high > 0 ? 0.5 : -0.5);
    return quarter - atan(x / y);
  }
  if (x.value.high > 0) return atan(y / x);
  return y.value.high < -y.error ? atan(y / x) - pi() : atan(y / x) + pi();
}

Counted asin(const Counted& a) {
  return atan2(a, sqrt((Counted(1.0) - a) * (Counted(1.0) + a)));
}

Counted acos(const Counted& a) {
  return atan2(sqrt((Counted(1.0) - a) * (Counted(1.0) + a)), a);
}

Counted pi() {
  return {kPi, 0x1p-105};
}

Counted radians(double degrees) {
  return Counted(degrees) * pi() / Counted(180.0);
}

Counted sin_deg(double degrees) {
  const double sign = degrees < 0 ? -1 : 1;
  double angle = std::abs(degrees);  // every difference below is exact
  if (angle > 180) return Counted(sign) * -sin_deg(angle - 180);
  if (angle > 90) angle = 180 - angle;
  const bool complement = angle > 45;
  const Counted x = radians(complement ? 90 - angle : angle);
  if (x.value.high == 0) return Counted(complement ? sign : 0.0);
  const SineCosine at = sine_cosine(x.value);
  return with_error((complement ? at.cosine : at.sine) * sign, x.error, kFunctionError);
}

Counted cos_deg(double degrees) {
  const double angle = std::abs(degrees);
  if (angle > 180) return -cos_deg(angle - 180);
  if (angle > 90) return -cos_deg(180 - angle);
  if (angle > 45) return sin_deg(90 - angle);
  const Counted x = radians(angle);
  return with_error(sine_cosine(x.value).cosine, x.error, kFunctionError);
}

Counted tan_pi_over(int n) {
  require(n >= 3, "tan_pi_over: a polygon has three sides at least");
  if (n == 3) return sqrt(Counted(3.0));
  const Counted x = pi() / Counted(n);
  const SineCosine at = sine_cosine(x.value);
  return with_error(at.sine, x.error, kFunctionError) / with_error(at.cosine, x.error, kFunctionError);
}

Counted root1p(const Counted& x) {
  const Counted x2 = x * x;
  return x2 / (Counted(1.0) + sqrt(Counted(1.0) + x2));
}

Counted hypot(const Counted& a, const Counted& b) {
  return sqrt(a * a + b * b);
}

Bounded bounded(const Counted& a) {
  const double value = rounded(a.value);
  return {value, (a.error + kUnitRoundoff * std::abs(value)) * kCountSlack};
}

}  // namespace etendue::catalogue
