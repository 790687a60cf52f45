// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/reflect.hpp"

#include <array>
#include <cstdint>

#include "etendue/core/rounding.hpp"
#include "optics/incidence.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Integers = std::array<std::int64_t, 3>;

std::int64_t dot(const Integers& a, const Integers& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec3 over(const Integers& v, double length) {
  return {static_cast<double>(v[0]) / length, static_cast<double>(v[1]) / length, static_cast<double>(v[2]) / length};
}

// Integer vectors of integer length: divided by it, rational unit vectors.
struct RationalDirection {
  Integers vector;
  std::int64_t length;
};
constexpr RationalDirection kRationals[] = {{{1, 2, 2}, 3},    {{2, 3, 6}, 7},    {{1, 4, 8}, 9},   {{4, 4, 7}, 9},
                                            {{2, 6, 9}, 11},   {{6, 6, 7}, 11},   {{3, 4, 12}, 13}, {{2, 5, 14}, 15},
                                            {{2, 10, 11}, 15}, {{1, 12, 12}, 17}, {{8, 9, 12}, 17}, {{0, 3, 4}, 5}};

// What one rounding of each component of δ and s can move the mirrored direction by: once for δ, four times for s.
constexpr double kRationalInput = 5 * kInputRounding;

// CLAIM      IU.5-3, IU.5-4, IU.5-5, RT.16: N' = N(N·V), S = N' − V, R = N' + S = 2N(N·V) − V = δ − 2(δ·s)s for V = −δ,
//            and the code gives it.
// ORACLE     integers: the identity in Z³, the mirrored direction as a rational number.
// TOLERANCE  none for the identity; reflection_error() and the rounding of the rational input for the code.
TEST(Reflect, AgreesWithBothPrintedFormsInRationalNumbers) {
  proves({"IU.5-3", "IU.5-4", "IU.5-5", "RT.16"}, Oracle::exact, "rational unit vectors in integer arithmetic");
  Directions random(2101);
  std::uint64_t mismatches = 0, identities = 0;
  for (const RationalDirection& incident : kRationals) {
    for (const RationalDirection& normal : kRationals) {
      Integers d = incident.vector, s = normal.vector;
      for (std::size_t i = 0; i < 3; ++i) d[i] *= random.integer(0, 1) * 2 - 1;
      for (std::size_t i = 0; i < 3; ++i) s[i] *= random.integer(0, 1) * 2 - 1;
      const std::int64_t n2 = normal.length * normal.length;
      Integers by_sines, by_projection;  // both times length · n2
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t v = -d[i] * n2;
        const std::int64_t cosine_vector = s[i] * -dot(s, d);
        const std::int64_t sine_vector = cosine_vector - v;
        by_sines[i] = cosine_vector + sine_vector;
        by_projection[i] = d[i] * n2 - 2 * dot(d, s) * s[i];
        mismatches += by_sines[i] != by_projection[i] ? 1U : 0U;
        ++identities;
      }
      const Vec3 expected = over(by_projection, static_cast<double>(incident.length * n2));
      const Vec3 actual =
          reflect(over(d, static_cast<double>(incident.length)), over(s, static_cast<double>(normal.length)));
      EXPECT_TRUE(within((actual - expected).norm(), reflection_error() + kRationalInput));
    }
  }
  EXPECT_TRUE(all_agree(mismatches, identities));
}

// CLAIM      RT.16, IU.5-5: reflect() keeps its bound in random frames, at grazing and at normal incidence.
// ORACLE     5-5 at 600 bits.
// TOLERANCE  reflection_error(), NOTES.md §2.
TEST(Reflect, KeepsItsBoundAtEveryAngle) {
  proves({"RT.16", "IU.5-5"}, Oracle::closed_form, "5-5 at 600 bits");
  Directions random(2102);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 s = random.unit();
    const double small = std::exp2(-random.uniform(0, 60));
    const Vec3 direction = i % 3 == 0   ? random.unit()
                           : i % 3 == 1 ? random.incident(s, 1, random.sign() * small)
                                        : random.incident(s, small, random.sign());
    const Vec3 mirrored = reflect(direction, s);
    EXPECT_TRUE(
        within(oracle::distance_to_reflection(triple(direction), triple(s), triple(mirrored)), reflection_error()));
    EXPECT_TRUE(within(std::abs(mirrored.norm() - 1), reflection_error() + 3 * kUnitRoundoff));  // and of norm()
  }
}

// CLAIM      IU.5-5: the formula is even in N, so that turning N round changes nothing (half of E11).
// ORACLE     metamorphic: reflect(δ, s) against reflect(δ, −s), bit by bit.
// TOLERANCE  none.
TEST(Reflect, IsTheSameForBothSidesOfTheNormal) {
  proves({"IU.5-5", "E11"}, Oracle::metamorphic, "normal reversed, bit by bit");
  Directions random(2103);
  std::uint64_t mismatches = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 direction = random.unit(), s = random.unit();
    mismatches += reflect(direction, s) != reflect(direction, -s) ? 1U : 0U;
  }
  EXPECT_TRUE(all_agree(mismatches, 2000));
}

// CLAIM      RT.16: a path of a thousand reflections keeps unit length: no drift builds up.
// ORACLE     identity: a mirror direction is a unit vector.
// TOLERANCE  reflection_error() and three roundings of norm(), the same at every depth.
TEST(Reflect, DoesNotDriftAlongAPath) {
  proves({"RT.16"}, Oracle::identity, "length one after each of 1000 reflections");
  Directions random(2104);
  Vec3 direction = random.unit();
  for (int i = 0; i < 1000; ++i) {
    direction = reflect(direction, random.unit());
    EXPECT_TRUE(within(std::abs(direction.norm() - 1), reflection_error() + 3 * kUnitRoundoff));
  }
}

// CLAIM      RT.19 (third exercise), R9: (3,2,1) is reflected at the normal (0, √2/2, −√2/2) into (3,1,2), though
//            δ·s > 0.
// ORACLE     exact: the projector s sᵀ is ½ (0,1,−1)(0,1,−1)ᵀ, rational, so the answer is found in integers.
// TOLERANCE  reflection_error() and the rounding of the input, times the length √14.
TEST(Reflect, SolvesTheThirdExercise) {
  proves({"RT.19", "R9"}, Oracle::exact, "the projector in integers");
  const Integers incident = {3, 2, 1}, axis = {0, 1, -1};
  Integers expected = {};
  for (std::size_t i = 0; i < 3; ++i) expected[i] = incident[i] - dot(incident, axis) * axis[i];
  EXPECT_EQ(expected, (Integers{3, 1, 2}));
  const double length = std::sqrt(14.0), half = std::sqrt(0.5);
  const Vec3 direction = over(incident, length), normal(0, half, -half);
  EXPECT_GT(direction.dot(normal), 0);
  const Vec3 actual = reflect(direction, normal) * length;
  EXPECT_TRUE(
      within((actual - over(expected, 1)).norm(), length * (reflection_error() + kRationalInput + 4 * kUnitRoundoff)));
}

// CLAIM      R3: (−δ·s)s is the projection of −δ, not of δ as printed.
// ORACLE     identity: what is left after projecting on s is orthogonal to s.
// TOLERANCE  none: all numbers are dyadic.
TEST(Reflect, ShowsThePrintedProjectionToBeThatOfTheOppositeVector) {
  proves({"R3"}, Oracle::identity, "remainder of a projection");
  const Vec3 direction(0.5, 0.25, -0.75), s(0, 0, 1);
  const Vec3 printed = -direction.dot(s) * s;
  EXPECT_TRUE(near((direction - printed).dot(s), -1.5, 0));
  EXPECT_TRUE(near((-direction - printed).dot(s), 0, 0));
}

// CLAIM      R4: without |s| = 1 the printed form is no reflection: s = (0,0,2) turns (1,0,−1) into (1,0,7). The code
//            refuses.
// ORACLE     exact: small integers.
// TOLERANCE  none.
TEST(Reflect, RefusesVectorsThatAreNotUnit) {
  proves({"R4"}, Oracle::exact, "the printed form in integers");
  const Vec3 slanted(1, 0, -1), doubled(0, 0, 2);
  const Vec3 printed = slanted - 2 * slanted.dot(doubled) * doubled;
  EXPECT_TRUE(within((printed - Vec3(1, 0, 7)).norm(), 0));
  const auto at = [](const Vec3& direction, const Vec3& normal) {
    return accepted([=] { return reflect(direction, normal); });
  };
  const Vec3 in_single_precision = slanted.cast<float>().normalized().cast<double>();
  EXPECT_TRUE(all_agree(at(slanted.normalized(), doubled) + at(slanted, Vec3::UnitZ()) +
                            at(Vec3(0, 0, std::nan("")), Vec3::UnitZ()) + at(in_single_precision, Vec3::UnitZ()),
                        4));
}

}  // namespace
}  // namespace etendue::validation
