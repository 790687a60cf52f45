// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/dispersion.hpp"

#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/optics/absorption.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

struct Published {
  const char* medium;
  double d, f, c, abbe;
  double abbe_digit;  ///< last digit of the published Abbe number
};

/// Data sheets of Schott (2017); for fused silica Malitson's own values, as rounded by its makers.
constexpr Published kCatalogue[] = {
    {"N-BK7", 1.51680, 1.52238, 1.51432, 64.17, 0.01},      {"F2", 1.62004, 1.63208, 1.61503, 36.37, 0.01},
    {"SF11", 1.78472, 1.80645, 1.77599, 25.76, 0.01},       {"N-SF11", 1.78472, 1.80651, 1.77596, 25.68, 0.01},
    {"fused silica", 1.45846, 1.46313, 1.45637, 67.8, 0.1},
};

// CLAIM      IU.4-6: η depends on the wavelength, as catalogues of glass say: the index for the lines d, F and C and Abbe's number.
// ORACLE     table: the data sheets.
// TOLERANCE  half a unit of the last printed digit.
TEST(Dispersion, FollowsTheCatalogue) {
  proves({"IU.4-6"}, Oracle::table, "n_d, n_F, n_C and Abbe numbers of five glasses");
  for (const Published& row : kCatalogue) {
    const KnownMedium* const medium = find_medium(row.medium);
    ASSERT_NE(medium, nullptr) << row.medium;
    EXPECT_TRUE(near(refractive_index(medium->dispersion, kLineD), row.d, 5e-6)) << row.medium;
    EXPECT_TRUE(near(refractive_index(medium->dispersion, kLineF), row.f, 5e-6)) << row.medium;
    EXPECT_TRUE(near(refractive_index(medium->dispersion, kLineC), row.c, 5e-6)) << row.medium;
    EXPECT_TRUE(near(abbe_number(medium->dispersion), row.abbe, row.abbe_digit / 2)) << row.medium;
  }
  EXPECT_EQ(find_medium("butter"), nullptr);
}

// CLAIM      Water at 20 °C has the index 1.33299 for sodium's light against air, 1.33335 against vacuum.
// ORACLE     table: CRC Handbook of Chemistry and Physics (589.29 nm), times the index of air, 1.000272 (Edlén 1966).
// TOLERANCE  1e-5, a unit of the last digit of the table.
TEST(Dispersion, KnowsWater) {
  proves({"IU.4-6"}, Oracle::table, "CRC's index of water for the D lines");
  EXPECT_TRUE(near(refractive_index(find_medium("water")->dispersion, 589.29), 1.33299 * 1.000272, 1e-5));
}

// CLAIM      Cauchy's and Sellmeier's formulas are evaluated as written; a medium without dispersion has no finite Abbe number.
// ORACLE     closed form: numbers that multiply without remainder; the same quotients in long double.
// TOLERANCE  8 u; for Sellmeier's the header's sum, below 40 u here.
TEST(Dispersion, EvaluatesBothFormulas) {
  proves({"IU.4-6"}, Oracle::closed_form, "1.5 + 0.004/0.25 + 0.0001/0.0625, and Sellmeier's sum in long double");
  EXPECT_TRUE(near(refractive_index(Cauchy{1.5, 0.004, 0.0001}, 500), 1.5176, 8 * 1.6 * u));
  const Sellmeier two{{0.75, 0.5}, {0.0078125, 100}};
  for (const double wavelength : {380.0, 500.0, 780.0}) {
    const long double square = static_cast<long double>(wavelength) * wavelength / 1e6L;
    const long double index = std::sqrt(1 + 0.75L * square / (square - 0.0078125L) + 0.5L * square / (square - 100));
    EXPECT_TRUE(near(refractive_index(two, wavelength), static_cast<double>(index), 40 * u));
  }
  EXPECT_TRUE(holds(std::isinf(abbe_number(Cauchy{1.5, 0, 0}))));
}

// CLAIM      Wavelengths that no eye sees are refused; a formula with a pole among the visible ones is told from a medium's.
// ORACLE     identity: the documented range; C = 0.25 µm² puts the pole at 500 nm.
// TOLERANCE  none.
TEST(Dispersion, RefusesWhatIsNotInItsDomain) {
  proves({}, Oracle::identity, "the documented domain");
  const Cauchy glass{1.5, 0.004, 0};
  for (const double wrong : {0.0, 379.9, 780.1, 0.55, std::nan("")}) {
    EXPECT_TRUE(refuses([&] { (void)refractive_index(glass, wrong); })) << wrong;
  }
  EXPECT_TRUE(holds(has_index(glass, 1, 2)));
  EXPECT_TRUE(holds(!has_index(glass, 1, 1.51)));
  EXPECT_TRUE(holds(!has_index(Sellmeier{{1}, {0.25}}, 0.1, 10)));
}

// CLAIM      Beer and Lambert: exp(−σ d) is left, per channel; nothing is lost where σ = 0, at any distance, and all of it on an
//            infinite way where σ > 0; two stretches multiply.
// ORACLE     closed form: the exponential in long double; the law's own functional equation.
// TOLERANCE  (2 + σ d) u relatively: the product's rounding, and an ulp of exp().
TEST(Absorption, FollowsBeersLaw) {
  proves({}, Oracle::closed_form, "exp(−σ d) in long double");
  const Eigen::Array3d sigma(0.25, 1.7, 0);
  for (const double distance : {0.0, 1e-3, 0.6, 7.0, 300.0}) {
    const Eigen::Array3d left = transmittance(sigma, distance);
    for (int k = 0; k < 3; ++k) {
      const double expected = static_cast<double>(std::exp(-static_cast<long double>(sigma[k]) * distance));
      EXPECT_TRUE(near(left[k], expected, (2 + sigma[k] * distance) * u * expected));
    }
    const Eigen::Array3d halves = transmittance(sigma, distance / 2);
    EXPECT_TRUE(near(halves[0] * halves[0], left[0], (6 + 2 * sigma[0] * distance) * u * left[0]));
  }
  const Eigen::Array3d endless = transmittance(sigma, HUGE_VAL);
  EXPECT_TRUE(holds(endless[0] == 0 && endless[1] == 0 && endless[2] == 1));
}

}  // namespace
}  // namespace etendue::validation
