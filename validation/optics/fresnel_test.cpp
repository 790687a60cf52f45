// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/fresnel.hpp"

#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/optics/refract.hpp"
#include "optics/incidence.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

struct Incidence {
  double cosine;
  double eta;
};

// Any angle; then 2^-1 … 2^-52 from normal and from grazing incidence; then one ulp of eta around the critical angle.
Incidence draw(Directions& random, int i) {
  const double eta = std::exp2(random.uniform(-10, 10));
  switch (i % 5) {
    case 0:
      return {random.uniform(0, 1), eta};
    case 1:
      return {1 - std::exp2(-random.uniform(1, 53)), eta};
    case 2:
      return {std::exp2(-random.uniform(1, 60)), eta};
    case 3:
      return {random.uniform(0, 1), 1 + random.sign() * std::exp2(-random.uniform(5, 52))};
    default:
      break;
  }
  const double cosine = random.integer(0, 1) == 0 ? random.uniform(0, 1) : std::exp2(-random.uniform(1, 24));
  double critical = 1 / std::sqrt((1 - cosine) * (1 + cosine));
  for (int steps = random.integer(-3, 3); steps != 0; steps += steps > 0 ? -1 : 1)
    critical = std::nextafter(critical, steps > 0 ? 2000.0 : 0.0);
  return {cosine, std::min(critical, kGreatestIndexRatio)};
}

// CLAIM      IU.4.2.2F: the factor keeps its relative bound at every angle and index, also beside the critical angle
//            and for nearly equal indices.
// ORACLE     the formula of the text, with φ the angle of refraction, at 600 bits from both angles.
// TOLERANCE  fresnel_relative_error(), NOTES.md §4.
TEST(Fresnel, KeepsItsRelativeBound) {
  proves({"IU.4.2.2F", "E6"}, Oracle::closed_form, "sines and tangents of both angles at 600 bits");
  Directions random(2301);
  for (int i = 0; i < 20000; ++i) {
    const Incidence at = draw(random, i);
    if (at.eta == 1) continue;
    const double factor = fresnel_reflectance(at.cosine, at.eta);
    const double radicand = at.eta * at.eta * at.cosine * at.cosine + (1 - at.eta) * (1 + at.eta);
    const bool steep = radicand > 4 * kSteepCosine * kSteepCosine;  // however the plain radicand errs
    const double bound = fresnel_relative_error(at.eta, steep ? kSteepCosine : 0);
    EXPECT_TRUE(within(oracle::relative_distance_to_fresnel(at.cosine, at.eta, factor), bound))
        << "cosine " << at.cosine << " eta " << at.eta;
    EXPECT_TRUE(0 <= factor && factor <= 1);
  }
}

// CLAIM      IU.4.2.2F: energy: what is not reflected is transmitted.
// ORACLE     the transmittance from the amplitude ratios t_s, t_p, an independent pair of formulas, at 600 bits.
// TOLERANCE  fresnel_relative_error(eta) for R; 2 u for the rounded T and the sum.
TEST(Fresnel, ConservesEnergy) {
  proves({"IU.4.2.2F"}, Oracle::identity, "R + T = 1, T from the amplitudes");
  Directions random(2302);
  for (int i = 0; i < 5000; ++i) {
    const double eta = std::exp2(random.uniform(-4, 4));
    const double cosine = eta <= 1 ? random.uniform(0.001, 1) : std::sqrt(random.uniform(1 - 0.999 / (eta * eta), 1));
    const double reflected = fresnel_reflectance(cosine, eta);
    const double transmitted = oracle::fresnel_transmittance(cosine, eta);
    EXPECT_TRUE(near(reflected + transmitted, 1, fresnel_relative_error(eta) * reflected + 2 * u));
  }
}

// CLAIM      IU.4.2.2F: at normal incidence the limit is ((η−1)/(η+1))², the same from both sides; at grazing
//            incidence 1; on total internal reflection 1; 0 where there is no boundary.
// ORACLE     closed form, exact for the limits.
// TOLERANCE  fresnel_relative_error(eta) and 4 u for the closed form in double.
TEST(Fresnel, HasTheRightLimits) {
  proves({"IU.4.2.2F"}, Oracle::closed_form, "((η−1)/(η+1))²");
  Directions random(2303);
  for (int i = 0; i < 1000; ++i) {
    const double eta = std::exp2(random.uniform(-4, 4)), ratio = (eta - 1) / (eta + 1), limit = ratio * ratio;
    EXPECT_TRUE(near(fresnel_reflectance(1, eta), limit, (fresnel_relative_error(eta) + 8 * u) * limit));
    EXPECT_TRUE(near(fresnel_reflectance(0, eta), 1, 0));
    EXPECT_TRUE(near(fresnel_reflectance(random.uniform(0, 1), 1), 0, 0));
    if (eta < 1.01) continue;
    const double beyond = random.uniform(0, 0.999) * std::sqrt(1 - 1 / (eta * eta));
    EXPECT_TRUE(near(fresnel_reflectance(beyond, eta), 1, 0));
  }
}

// CLAIM      E6: with the earlier meaning of φ (0: the view along the mirror direction) the printed factor is 1 at 60°,
//            where the right one is 0.0892 for glass; at 0° it is 0/0, where the limit is 0.04.
// ORACLE     closed form: Fresnel's equations from cosines, 60° into 1.5.
// TOLERANCE  half a unit of the last printed digit for the numbers of the text, fresnel_relative_error() otherwise.
TEST(Fresnel, NeedsTheAngleOfRefraction) {
  proves({"E6", "IU.4.2.2F"}, Oracle::closed_form, "Fresnel's equations from the two cosines");
  const auto printed = [](double theta, double phi) {
    const double sines = std::sin(phi - theta) / std::sin(phi + theta);
    const double tangents = std::tan(phi - theta) / std::tan(phi + theta);
    return 0.5 * (sines * sines + tangents * tangents);
  };
  EXPECT_TRUE(near(printed(60 * kDegree, 0), 1, 4 * u));
  EXPECT_TRUE(std::isnan(printed(0, 0)));
  const double behind = std::sqrt(1 - 0.75 / 2.25);
  const double r_s = (0.5 - 1.5 * behind) / (0.5 + 1.5 * behind), r_p = (1.5 * 0.5 - behind) / (1.5 * 0.5 + behind);
  EXPECT_TRUE(near(fresnel_reflectance(0.5, 1 / 1.5), 0.5 * (r_s * r_s + r_p * r_p), fresnel_relative_error(1 / 1.5)));
  EXPECT_TRUE(near(fresnel_reflectance(0.5, 1 / 1.5), 0.0892, 5e-5));
  EXPECT_TRUE(near(fresnel_reflectance(1, 1 / 1.5), 0.04, 0.04 * fresnel_relative_error(1 / 1.5) + u));
}

// CLAIM      IU.4.2.2F: the contract is enforced.
// ORACLE     identity: the documented domain.
// TOLERANCE  none.
TEST(Fresnel, RefusesWhatIsNotInItsDomain) {
  proves({"IU.4.2.2F"}, Oracle::identity, "the documented domain");
  const auto at = [](double cosine, double eta) { return accepted([=] { return fresnel_reflectance(cosine, eta); }); };
  EXPECT_TRUE(all_agree(at(-0.1, 1.5) + at(1.1, 1.5) + at(std::nan(""), 1.5) + at(0.5, 0), 4));
}

}  // namespace
}  // namespace etendue::validation
