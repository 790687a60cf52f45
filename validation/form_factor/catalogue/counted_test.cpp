// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/counted.hpp"

#include <functional>

#include "form_factor/catalogue/configurations.hpp"
#include "oracles/ball.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using catalogue::Counted;
using oracle::Ball;
constexpr std::uint64_t kSeed = 7;

/// |value − truth|, in balls; rounded up a little by the conversion to double.
double error(const Counted& actual, const Ball& truth) {
  const Ball difference = Ball(actual.value.high) + Ball(actual.value.low) - truth;
  return std::abs(difference.midpoint());
}

Ball log1p(const Ball& x) {
  return log(Ball(1) + x);
}

struct Function {
  const char* name;
  Counted (*ours)(const Counted&);
  Ball (*truth)(const Ball&);
  double low, high;
  bool both_signs;
};

// CLAIM      IU.6-3: the elementary functions behind the catalogue's proved bounds err by less than they count.
// ORACLE     closed form: Arb's functions at 600 bits.
// TOLERANCE  the counted error, which is at most 3 kFunctionError of the value or of 1.
TEST(Counted, CountsTheErrorsOfItsFunctions) {
  proves({"IU.6-3"}, Oracle::closed_form, "log, log1p, atan, sqrt at 600 bits, 2000 arguments each over their ranges");
  uses_seed(kSeed);
  const Function functions[] = {
      {"log", [](const Counted& x) { return catalogue::log(x); }, [](const Ball& x) { return log(x); }, 1e-30, 1e30,
       false},
      {"log near 1", [](const Counted& x) { return catalogue::log(x); }, [](const Ball& x) { return log(x); }, 0.5, 2,
       false},
      {"log1p", [](const Counted& x) { return catalogue::log1p(x); }, log1p, 1e-25, 0.9, true},
      {"log1p large", [](const Counted& x) { return catalogue::log1p(x); }, log1p, 0.1, 1e20, false},
      {"atan", [](const Counted& x) { return catalogue::atan(x); }, [](const Ball& x) { return atan(x); }, 1e-20, 1e20,
       true},
      {"atan near 1", [](const Counted& x) { return catalogue::atan(x); }, [](const Ball& x) { return atan(x); }, 0.1,
       10, true},
      {"sqrt", [](const Counted& x) { return catalogue::sqrt(x); }, [](const Ball& x) { return sqrt(x); }, 1e-30, 1e30,
       false}};
  CounterRandom random(kSeed);
  for (const Function& f : functions) {
    for (int i = 0; i < 2000; ++i) {
      const double x = (f.both_signs && i % 2 == 0 ? -1 : 1) * random.scale(f.low, f.high);
      const Counted y = f.ours(Counted(x));
      EXPECT_TRUE(within(error(y, f.truth(Ball(x))), y.error)) << f.name << " " << x;
      EXPECT_TRUE(within(y.error, 3 * catalogue::kFunctionError * std::max(1.0, std::abs(y.value.high))))
          << f.name << " " << x;
    }
  }
}

// CLAIM      IU.6-3: angles given in degrees have sines and cosines right to the count, exact at right angles.
// ORACLE     closed form: Arb's functions at 600 bits.
// TOLERANCE  the counted error; none at multiples of 90°.
TEST(Counted, TakesDegreesExactly) {
  proves({"IU.6-3"}, Oracle::closed_form, "sin and cos of 4000 angles in degrees at 600 bits");
  CounterRandom random(kSeed + 1);
  for (int i = 0; i < 4000; ++i) {
    const double angle = i % 4 == 0 ? random.scale(1e-12, 360) : 720 * random.unit() - 360;
    const Ball x = Ball(angle) * oracle::pi() / Ball(180);
    const Counted s = catalogue::sin_deg(angle), c = catalogue::cos_deg(angle);
    EXPECT_TRUE(within(error(s, sin(x)), s.error)) << angle;
    EXPECT_TRUE(within(error(c, cos(x)), c.error)) << angle;
  }
  for (const double angle : {0.0, 90.0, 180.0, 270.0, 360.0, -90.0, -180.0}) {
    const Counted s = catalogue::sin_deg(angle), c = catalogue::cos_deg(angle);
    EXPECT_TRUE(holds(s.value.high * c.value.high == 0 && std::abs(s.value.high) + std::abs(c.value.high) == 1))
        << angle;
  }
  for (const int n : {3, 4, 5, 6, 7, 12, 100, 1000}) {
    const Ball x = oracle::pi() / Ball(n);
    const Counted t = catalogue::tan_pi_over(n);
    EXPECT_TRUE(within(error(t, sin(x) / cos(x)), t.error)) << n;
  }
}

// CLAIM      IU.6-3: sums, products, quotients and roots of numbers with errors enclose the truth, wherever in its error
//            each number lies.
// ORACLE     closed form: the same operations in balls of 600 bits on shifted numbers.
// TOLERANCE  the counted error.
TEST(Counted, EnclosesWhatItsArgumentsMayBe) {
  proves({"IU.6-3"}, Oracle::closed_form, "8 operations on 3000 pairs, each argument at either end of its error");
  CounterRandom random(kSeed + 2);
  const auto ball = [](const Counted& a, double end) {
    return Ball(a.value.high) + Ball(a.value.low) + Ball(end) * Ball(a.error);
  };
  for (int i = 0; i < 3000; ++i) {
    // One number a statement: the order in which arguments are evaluated is the compiler's choice.
    const double a_error = random.scale(1e-30, 1e-3) * 1e-6, a_size = random.scale(1e-6, 1e6);
    const Counted a(DoubleDouble((random.unit() < 0.5 ? -1 : 1) * a_size), a_error);
    const double b_error = random.scale(1e-30, 1e-3) * 1e-6;
    const Counted b(DoubleDouble(random.scale(1e-6, 1e6)), b_error);
    for (const double p : {-1.0, 1.0}) {
      for (const double q : {-1.0, 1.0}) {
        const Ball x = ball(a, p), y = ball(b, q);
        const auto check = [&](const Counted& ours, const Ball& truth, const char* name) {
          EXPECT_TRUE(within(error(ours, truth), ours.error)) << name << " " << a.value.high << " " << b.value.high;
        };
        check(a + b, x + y, "+");
        check(a - b, x - y, "-");
        check(a * b, x * y, "*");
        check(a / b, x / y, "/");
        check(catalogue::sqrt(b), sqrt(y), "sqrt");
        check(catalogue::log(b), log(y), "log");
        check(catalogue::atan(a), atan(x), "atan");
        check(catalogue::log1p(b), log1p(y), "log1p");
      }
    }
  }
}

}  // namespace
}  // namespace etendue::validation
