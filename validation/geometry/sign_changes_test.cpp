// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/sign_changes.hpp"

#include <cmath>
#include <vector>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

BoundedPolynomial polynomial(const std::vector<double>& coefficients) {
  BoundedPolynomial p;
  for (std::size_t k = 0; k < coefficients.size(); ++k) p.coefficient[k] = DoubleDouble(coefficients[k]);
  return p;
}

// CLAIM      exact polynomials of any degree up to four, leading coefficients of one included, change their signs where they do; what
//            is promised of each place holds, and is not empty.
// ORACLE     closed form: √2 to twice the digits of a double by one step of Newton's with an exact square; small integers.
// TOLERANCE  each zero's own error, below 2^-90: the signs are certain from 2^-98 of the terms on, over a slope of 2.8; 2^-103 for
//            the oracle's own low part.
TEST(SignChanges, AreFoundWithTheirErrors) {
  proves({"IU.5.0"}, Oracle::closed_form, "zeros of small integer polynomials");
  constexpr double kCertain = 0x1p-90, kOracle = 0x1p-103;
  const double high = std::sqrt(2.0), low = -std::fma(high, high, -2.0) / (2 * high);
  const SignChanges roots = sign_changes(polynomial({-2, 0, 1}), -3, 3);
  ASSERT_EQ(roots.count, 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const BoundedZero& zero = roots.zero[k];
    const double sign = k == 0 ? -1 : 1, off = (zero.x.high - sign * high) + (zero.x.low - sign * low);
    EXPECT_TRUE(within(std::abs(off), zero.error + kOracle));
    EXPECT_TRUE(within(zero.error, kCertain));
    EXPECT_TRUE(holds(zero.error > 0)) << "no pair of doubles is the root of two";
  }
  const auto places = [](const std::vector<double>& coefficients, double from, double to) {
    std::vector<double> found;
    const SignChanges changes = sign_changes(polynomial(coefficients), from, to);
    for (std::size_t k = 0; k < changes.count; ++k) found.push_back(std::round(1e9 * changes.zero[k].x.high) * 1e-9);
    return found;
  };
  using Places = std::vector<double>;
  EXPECT_TRUE(holds(places({-3, 1}, -9, 9) == Places{3}));
  EXPECT_TRUE(holds(places({-6, 11, -6, 1}, 0, 9) == Places{1, 2, 3}));
  EXPECT_TRUE(holds(places({24, -50, 35, -10, 1}, 0, 9) == Places{1, 2, 3, 4}));
  EXPECT_TRUE(holds(places({24, -50, 35, -10, 1}, 1.5, 3.5) == Places{2, 3}));
  EXPECT_TRUE(holds(places({1, -2, 1}, -9, 9).empty() && places({1}, -9, 9).empty())) << "what touches does not change";
}

}  // namespace
}  // namespace etendue::validation
