// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "etendue/optics/reflect.hpp"
#include "etendue/optics/refract.hpp"
#include "optics/incidence.hpp"
#include "support/evidence.hpp"
#include "support/exhibit.hpp"

// refract() and reflect() against 600 bits, on families in random frames, and the decision "total internal reflection"
// against exact arithmetic.
namespace etendue::validation {
namespace {

struct Case {
  Vec3 direction;
  Vec3 normal;
  double eta;
};
using Family = std::vector<Case>;

Family general(int count) {
  Directions random(2001);
  Family cases;
  for (int i = 0; i < count; ++i) cases.push_back({random.unit(), random.unit(), std::exp2(random.uniform(-3, 3))});
  return cases;
}

// 2^-5 … 2^-60 from grazing, on both sides; denser and thinner media in turn.
Family grazing(int count) {
  Directions random(2002);
  Family cases;
  for (int i = 0; i < count; ++i) {
    const Vec3 s = random.unit();
    const double cosine = random.sign() * std::exp2(-random.uniform(5, 60));
    cases.push_back({random.incident(s, 1, cosine), s, std::exp2(random.uniform(-3, i % 2 == 0 ? 0 : 3))});
  }
  return cases;
}

// 2^-5 … 2^-60 from normal incidence, then exactly normal; from both sides, up to the largest indices.
Family normal_incidence(int count) {
  Directions random(2003);
  Family cases;
  for (int i = 0; i < count; ++i) {
    const Vec3 s = random.unit();
    const double eta = std::exp2(random.uniform(-10, 10));
    const double sine = std::min(std::exp2(-random.uniform(5, 60)), 0.9 / eta);
    cases.push_back({i % 4 == 0 ? Vec3(random.sign() * s) : random.incident(s, sine, random.sign()), s, eta});
  }
  return cases;
}

// The two neighbouring doubles between which the exact radicand changes its sign; `below` refracts, `above` does not.
struct CriticalPair {
  Case below;
  Case above;
};
CriticalPair critical_pair(const Vec3& direction, const Vec3& normal, double eta) {
  const auto refracts = [&](double index) {
    return oracle::sign_of_radicand(triple(direction), triple(normal), index) >= 0;
  };
  while (refracts(eta)) eta = std::nextafter(eta, 2000.0);
  while (!refracts(eta)) eta = std::nextafter(eta, 0.0);
  return {{direction, normal, eta}, {direction, normal, std::nextafter(eta, 2000.0)}};
}

// One ulp of eta on either side of the critical angle, from grazing (eta = 1 + 2^-40) to steep (eta = 1000).
std::vector<CriticalPair> near_critical(int count) {
  Directions random(2004);
  std::vector<CriticalPair> pairs;
  for (int i = 0; i < count; ++i) {
    const Vec3 s = random.unit();
    const double eta = i % 2 == 0 ? random.uniform(1.01, 3) : 1 + std::exp2(-random.uniform(-9.9, 40));
    const double sine = 1 / eta;
    const Vec3 direction = random.incident(s, sine, random.sign() * std::sqrt((1 - sine) * (1 + sine)));
    const Vec3 seen_sine = direction.cross(s);
    pairs.push_back(critical_pair(direction, s, 1 / seen_sine.norm()));
  }
  return pairs;
}

// Exactly critical, as rational numbers allow: sines 4/5, 8/17, 16/65 have dyadic reciprocals. The frame is a rotation
// with rational entries; what makes the vectors unit is a short factor that keeps every component exact.
Family exactly_critical(int count) {
  struct Triangle {
    int sine, cosine, hypotenuse;
  };
  const Triangle triangles[] = {{4, 3, 5}, {8, 15, 17}, {16, 63, 65}};
  Directions random(2005);
  Family cases;
  while (static_cast<int>(cases.size()) < count) {
    const Triangle& side = triangles[random.integer(0, 2)];
    const int a = random.integer(-4, 4), b = random.integer(-4, 4), c = random.integer(-4, 4), d = random.integer(1, 4);
    const double norm = a * a + b * b + c * c + d * d;
    const Vec3 x(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c));
    const Vec3 z(2 * (b * d + a * c), 2 * (c * d - a * b), a * a - b * b - c * c + d * d);
    // 42 bits: lengths are one within kUnitTolerance, and a product with entries of 11 bits is exact
    const double normal_scale = std::ldexp(std::round(std::ldexp(1 / norm, 42 + 7)), -42 - 7);
    const double length = norm * side.hypotenuse;
    const double scale = std::ldexp(std::round(std::ldexp(1 / length, 42 + 11)), -42 - 11);
    cases.push_back({scale * (side.sine * x - random.sign() * side.cosine * z), normal_scale * z,
                     static_cast<double>(side.hypotenuse) / side.sine});
  }
  return cases;
}

int exact_sign(const Case& c) {
  return oracle::sign_of_radicand(triple(c.direction), triple(c.normal), c.eta);
}

// 5-7 as it is printed, with the normal turned as it must be: what a direct transcription gives.
double plain_cosine(const Case& c) {
  const double dot = c.direction.dot(c.normal);
  return std::sqrt(std::max(0.0, 1 - c.eta * c.eta * (1 - dot * dot)));
}

// Counts the cases that refract; fails on the first one that leaves its bound.
int expect_within_bounds(const Family& cases, const char* shown_as = nullptr) {
  ErrorHistogram histogram(shown_as == nullptr ? "" : shown_as, "ulps of 1 (2^-52) of the refracted direction", 0.25,
                           24);
  int refracted = 0;
  for (const Case& c : cases) {
    if (exact_sign(c) < 0) continue;
    const auto cosine = refracted_cosine(c.direction, c.normal, c.eta);
    const auto ray = refract(c.direction, c.normal, c.eta);
    if (!cosine || !ray) {
      ADD_FAILURE() << "no ray for eta " << c.eta;
      return refracted;
    }
    const double cosine_distance =
        oracle::distance_to_refracted_cosine(triple(c.direction), triple(c.normal), c.eta, *cosine);
    EXPECT_TRUE(within(cosine_distance, refraction_cosine_error(c.eta, *cosine))) << "cosine, eta " << c.eta;
    const double distance = oracle::distance_to_refraction(triple(c.direction), triple(c.normal), c.eta, triple(*ray));
    EXPECT_TRUE(within(distance, refraction_error(c.eta, *cosine))) << "direction, eta " << c.eta;
    histogram.add(distance / 0x1p-52);
    ++refracted;
  }
  if (shown_as != nullptr) exhibit(histogram);
  return refracted;
}

// CLAIM      IU.5-6, IU.5-7, RT.18: refract() and the cosine keep their bounds at any angle and index.
// ORACLE     5-7 at 600 bits, with the exact radicand.
// TOLERANCE  refraction_error(), refraction_cosine_error(), NOTES.md §3.
TEST(RefractAccuracy, KeepsItsBoundsInGeneralPosition) {
  proves({"IU.5-6", "IU.5-7", "RT.18"}, Oracle::closed_form, "5-7 at 600 bits on random frames");
  EXPECT_GE(expect_within_bounds(general(20000), "Refraction in general position"), 10000);
}

// CLAIM      IU.5-7, RT.18: the bounds hold 2^-5 to 2^-60 from grazing incidence, on both sides of the surface.
// ORACLE     5-7 at 600 bits; the side of incidence from the exact scalar product.
// TOLERANCE  refraction_error(), refraction_cosine_error().
TEST(RefractAccuracy, KeepsItsBoundsAtGrazingIncidence) {
  proves({"IU.5-7", "RT.18"}, Oracle::closed_form, "5-7 at 600 bits, grazing");
  EXPECT_GE(expect_within_bounds(grazing(10000), "Refraction at grazing incidence"), 5000);
}

// CLAIM      IU.5-7, RT.18: the bounds hold at and near normal incidence, for ratios of indices from 2^-10 to 2^10.
// ORACLE     5-7 at 600 bits.
// TOLERANCE  refraction_error(), refraction_cosine_error().
TEST(RefractAccuracy, KeepsItsBoundsAtNormalIncidence) {
  proves({"IU.5-7", "RT.18", "R1"}, Oracle::closed_form, "5-7 at 600 bits, near normal incidence");
  EXPECT_EQ(expect_within_bounds(normal_incidence(10000), "Refraction near normal incidence"), 10000);
}

// CLAIM      IU.5-7: the bounds hold one ulp of eta from the critical angle, where 5-7 in plain double is wrong in
//            the eighth digit.
// ORACLE     5-7 at 600 bits with the exact radicand.
// TOLERANCE  refraction_error(), refraction_cosine_error(). The plain form must break them a million times over.
TEST(RefractAccuracy, KeepsItsBoundsOneUlpFromTheCriticalAngle) {
  proves({"IU.5-7", "RT.18"}, Oracle::closed_form, "5-7 at 600 bits, one ulp inside the critical angle");
  Family inside;
  double plain_worst = 0, greatest_cosine = 0;
  for (const CriticalPair& pair : near_critical(8000)) {
    const Case& c = pair.below;
    const double distance =
        oracle::distance_to_refracted_cosine(triple(c.direction), triple(c.normal), c.eta, plain_cosine(c));
    plain_worst = std::max(plain_worst, distance / refraction_cosine_error(c.eta));
    greatest_cosine = std::max(greatest_cosine, refracted_cosine(c.direction, c.normal, c.eta).value_or(1));
    inside.push_back(c);
  }
  EXPECT_EQ(expect_within_bounds(inside), 8000);
  EXPECT_GT(plain_worst, 1e6);
  EXPECT_LT(greatest_cosine, kSteepCosine) << "the family must stand next to the critical angle";
}

// CLAIM      IU.5-7: at the critical angle itself the cosine is zero, within its bound; this is the hardest case of
//            all.
// ORACLE     rational frames, in which the exact radicand is zero (asserted).
// TOLERANCE  refraction_error(), refraction_cosine_error(); nullopt is the other right answer.
TEST(RefractAccuracy, GivesTheTangentAtTheCriticalAngle) {
  proves({"IU.5-7", "IU.5.3tir"}, Oracle::exact, "exactly critical directions in rational frames");
  Family tangents;
  for (const Case& c : exactly_critical(20000)) {
    ASSERT_EQ(exact_sign(c), 0);
    if (refracted_cosine(c.direction, c.normal, c.eta)) tangents.push_back(c);
  }
  EXPECT_GE(expect_within_bounds(tangents), 4000);
}

// CLAIM      IU.5.3tir: there is no transmitted ray exactly when the sine would exceed one; one ulp of eta decides.
// ORACLE     the sign of the radicand in exact dyadic arithmetic.
// TOLERANCE  none: one ulp moves the radicand by 2^-53, refraction_decision_error() is 2^-100.
TEST(RefractDecision, IsExactOneUlpFromTheCriticalAngle) {
  proves({"IU.5.3tir", "G7", "R2"}, Oracle::exact, "sign of the radicand in exact dyadic arithmetic");
  std::uint64_t mismatches = 0, decisions = 0, plain_mismatches = 0;
  const auto decide = [&](const Case& c) {
    const bool refracts = exact_sign(c) >= 0;
    mismatches += refract(c.direction, c.normal, c.eta).has_value() != refracts ? 1U : 0U;
    mismatches += refracted_cosine(c.direction, c.normal, c.eta).has_value() != refracts ? 1U : 0U;
    plain_mismatches += (plain_cosine(c) > 0) != refracts ? 1U : 0U;
    decisions += 2;
  };
  for (const CriticalPair& pair : near_critical(8000)) {
    decide(pair.below);
    decide(pair.above);
  }
  for (Case c : exactly_critical(1000)) {
    const double critical = c.eta;
    c.eta = std::nextafter(critical, 0.0);
    decide(c);
    c.eta = std::nextafter(critical, 2000.0);
    decide(c);
  }
  for (const Family& family : {general(4000), grazing(2000)}) {
    for (const Case& c : family) decide(c);
  }
  EXPECT_TRUE(all_agree(mismatches, decisions));
  EXPECT_GT(plain_mismatches, 100U) << "the family must be hard for the plain form";
}

// CLAIM      RT.18: lengths of the given vectors that are not exactly one do not show in the result.
// ORACLE     5-7 at 600 bits for the directions of the given vectors.
// TOLERANCE  refraction_error(), refraction_cosine_error(), reflection_error(), all without the defect of 2^-42.
TEST(RefractAccuracy, DividesOutLengthsThatAreNotExactlyOne) {
  proves({"RT.16", "RT.18", "R4"}, Oracle::closed_form, "5-7 at 600 bits, lengths off by 2^-42");
  Directions random(2006);
  Family cases = general(1000);
  for (const CriticalPair& pair : near_critical(500)) cases.push_back(pair.below);
  for (Case& c : cases) {
    c.direction *= 1 + random.uniform(-1, 1) * 0x1p-42;
    c.normal *= 1 + random.uniform(-1, 1) * 0x1p-42;
    const Vec3 mirrored = reflect(c.direction, c.normal);
    EXPECT_TRUE(within(oracle::distance_to_reflection(triple(c.direction), triple(c.normal), triple(mirrored)),
                       reflection_error()));
  }
  EXPECT_GE(expect_within_bounds(cases), 750);
}

}  // namespace
}  // namespace etendue::validation
