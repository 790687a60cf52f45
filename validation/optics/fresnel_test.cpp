// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/fresnel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

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

// CLAIM      IU.4.2.2F: a conductor's factor, at any angle and index, in the limits too; without absorption it is a dielectric's.
// ORACLE     closed form: amplitudes with the complex index in long double.
// TOLERANCE  kConductorError; for the dielectric both bounds.
TEST(Fresnel, KnowsConductors) {
  proves({"IU.4.2.2F"}, Oracle::closed_form, "complex amplitudes in long double, 20,000 angles and indices");
  using Complex = std::complex<long double>;
  Directions random(2304);
  for (int i = 0; i < 20000; ++i) {
    const double cosine = i % 3 == 0   ? random.uniform(0, 1)
                          : i % 3 == 1 ? std::exp2(-random.uniform(0, 60))
                                       : 1 - std::exp2(-random.uniform(1, 53));
    const double eta = std::exp2(random.uniform(-8, 8)), k = i % 5 == 0 ? 0 : std::exp2(random.uniform(-10, 6));
    const long double c = cosine, sines = (1 - c) * (1 + c);
    const Complex index(eta, k);
    Complex behind = std::sqrt(index * index - sines);
    if (behind.imag() < 0) behind = -behind;
    const Complex s = (c - behind) / (c + behind), p = (index * index * c - behind) / (index * index * c + behind);
    const double right = static_cast<double>((std::norm(s) + std::norm(p)) / 2);
    EXPECT_TRUE(near(fresnel_conductor(cosine, eta, k), right, kConductorError)) << cosine << ' ' << eta << ' ' << k;
    if (k == 0 && eta > 1) {  // 1/eta is rounded, which moves F by a few u where there is no critical angle
      EXPECT_TRUE(near(fresnel_conductor(cosine, eta, 0), fresnel_reflectance(cosine, 1 / eta),
                       kConductorError + fresnel_relative_error(1 / eta) + 4 * u));
    }
  }
  for (const double eta : {0.2, 1.0, 1.5}) EXPECT_TRUE(near(fresnel_conductor(0, eta, 3), 1, 0));
  // Without a boundary nothing is reflected, also where the cosine's square underflows; the least one with any has all.
  for (const double cosine : {0.0, 1e-300, 1e-160, 1e-8, 0.5, 1.0})
    EXPECT_TRUE(near(fresnel_conductor(cosine, 1, 0), 0, 0));
  EXPECT_TRUE(near(fresnel_conductor(1e-300, 1.5, 0), 1, kConductorError));
}

// CLAIM      IU.4.2.2F: Schlick's formula has the limits at normal and grazing incidence, and is within kSchlickError between them for
//            indices from 1.4 to 2: no further, as water (0.060) and diamond (0.076) show.
// ORACLE     independent method: fresnel_reflectance().
// TOLERANCE  kSchlickError, and at least half of it is used; three digits of the two counterexamples.
TEST(Fresnel, IsNearToSchlicksFormula) {
  proves({"IU.4.2.2F"}, Oracle::program, "the exact factor, 2,001 angles, seven indices");
  const auto worst = [](double eta) {
    const double normal = fresnel_reflectance(1, 1 / eta);
    double error = 0;
    for (int i = 0; i <= 2000; ++i) {
      const double cosine = i / 2000.0;
      error = std::max(error, std::abs(schlick(cosine, normal) - fresnel_reflectance(cosine, 1 / eta)));
    }
    return error;
  };
  for (const double eta : {1.4, 1.5, 1.6, 1.8, 2.0}) {
    EXPECT_TRUE(within(worst(eta), kSchlickError));
    EXPECT_GT(worst(eta), 0.5 * kSchlickError);
    EXPECT_TRUE(near(schlick(0, 0.04), 1, 0));
    EXPECT_TRUE(near(schlick(1, 0.04), 0.04, 0));
  }
  EXPECT_TRUE(near(worst(1.33), 0.060, 5e-4));
  EXPECT_TRUE(near(worst(2.42), 0.0757, 5e-4));
}

// CLAIM      IU.4.2.2F: the contract is enforced.
// ORACLE     identity: the documented domain.
// TOLERANCE  none.
TEST(Fresnel, RefusesWhatIsNotInItsDomain) {
  proves({"IU.4.2.2F"}, Oracle::identity, "the documented domain");
  const auto at = [](double cosine, double eta) { return accepted([=] { return fresnel_reflectance(cosine, eta); }); };
  const auto metal = [](double c, double eta, double k) {
    return accepted([=] { return fresnel_conductor(c, eta, k); });
  };
  EXPECT_TRUE(all_agree(at(-0.1, 1.5) + at(1.1, 1.5) + at(std::nan(""), 1.5) + at(0.5, 0) + metal(1.1, 1, 3) +
                            metal(1, 0, 3) + metal(1, 1, -1) + accepted([] { return schlick(0.5, 1.5); }),
                        8));
}

}  // namespace
}  // namespace etendue::validation
