// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/attenuation.hpp"

#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "optics/incidence.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

// CLAIM      IU.2-5: light weakens as 1/(d + d0).
// ORACLE     identity: f (d + d0) = 1.
// TOLERANCE  2.1 u of the factor, and 2 u for the sum and the product of the check.
TEST(LinearAttenuation, IsTheReciprocalOfTheShiftedDistance) {
  proves({"IU.2-5"}, Oracle::identity, "f (d + d0) = 1");
  Directions random(2601);
  for (int i = 0; i < 5000; ++i) {
    const double d0 = random.uniform(0, 2), d = std::exp2(random.uniform(0, 60));
    EXPECT_TRUE(near(linear_attenuation(d, d0) * (d + d0), 1, 4.2 * u));
  }
}

// CLAIM      G3: where d + d0 < 1 the printed factor amplifies (5 for d = d0 = 0.1); the code stays at 1,
//            continuously, and never grows with the distance.
// ORACLE     identity: no surface returns more than it is given; the factor is monotone.
// TOLERANCE  none.
TEST(LinearAttenuation, NeverAmplifies) {
  proves({"G3", "IU.2-5"}, Oracle::identity, "at most one, and monotone");
  const double d = 0.1, d0 = 0.1, printed = 1 / (d + d0);
  EXPECT_TRUE(near(printed, 5, 0));
  EXPECT_TRUE(near(linear_attenuation(d, d0), 1, 0));
  EXPECT_TRUE(near(linear_attenuation(0, 0), 1, 0));
  EXPECT_TRUE(near(linear_attenuation(0.75, 0.25), 1, 0));
  EXPECT_TRUE(near(linear_attenuation(1.75, 0.25), 0.5, 0));
  std::uint64_t rises = 0;
  double previous = 1;
  for (double distance = 0; distance < 8; distance += 0x1p-7) {
    const double factor = linear_attenuation(distance, 0.25);
    rises += factor > previous ? 1U : 0U;
    previous = factor;
  }
  EXPECT_TRUE(all_agree(rises, 1024));
}

// CLAIM      IU.2.6a: irradiance is Φ/(4πd²): all spheres around the source receive its whole power, and a source of
//            Φ has the intensity Φ/4π.
// ORACLE     identity: E times the sphere's area.
// TOLERANCE  4.1 u of the irradiance, and 4 u for the area and the product of the check.
TEST(InverseSquareLaw, CarriesThePowerThroughEverySphere) {
  proves({"IU.2.6a", "E7"}, Oracle::identity, "irradiance times the area of the sphere");
  Directions random(2602);
  for (int i = 0; i < 5000; ++i) {
    const double power = random.uniform(0.1, 1000), d = std::exp2(random.uniform(-20, 20));
    const double through_sphere = irradiance_of_power(power, d) * (4 * std::numbers::pi * d * d);
    EXPECT_TRUE(near(through_sphere / power, 1, 9 * u));
    const double intensity = power / (4 * std::numbers::pi);
    EXPECT_TRUE(near(irradiance_of_intensity(intensity, d) / irradiance_of_power(power, d), 1, 9 * u));
  }
}

// CLAIM      E7: "proportionally to the square of the distance" would give 4 at d = 2, where it is 0.25; and I_p/4πd²
//            with I_p taken for an intensity is 4π too small.
// ORACLE     exact for the powers of two; closed form for the factor.
// TOLERANCE  none; 4.1 u and one rounding for the factor 4π.
TEST(InverseSquareLaw, FallsWithTheSquare) {
  proves({"E7", "IU.2.6a"}, Oracle::exact, "powers of two");
  const double d = 2, printed = d * d;
  EXPECT_TRUE(near(printed, 4, 0));
  EXPECT_TRUE(near(irradiance_of_intensity(1, d), 0.25, 0));
  EXPECT_TRUE(near(irradiance_of_intensity(1, d) / irradiance_of_power(1, d) / (4 * std::numbers::pi), 1, 7 * u));
}

// CLAIM      IU.2-5, IU.2.6a: the contracts are enforced: no distance below zero, none of zero for the square law.
// ORACLE     identity: the documented domain.
// TOLERANCE  none.
TEST(Attenuation, RefusesWhatIsNotInItsDomain) {
  proves({"IU.2-5", "IU.2.6a"}, Oracle::identity, "the documented domain");
  const auto linear = [](double d, double d0) { return accepted([=] { return linear_attenuation(d, d0); }); };
  const auto square = [](double i, double d) { return accepted([=] { return irradiance_of_intensity(i, d); }); };
  EXPECT_TRUE(all_agree(linear(-1, 2) + linear(2, -1) + linear(INFINITY, 1) + linear(1, std::nan("")), 4));
  EXPECT_TRUE(all_agree(square(1, 0) + square(1, -1) + square(1, 1e-200) + square(-1, 1) + square(1, std::nan("")), 5));
}

}  // namespace
}  // namespace etendue::validation
