// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/optics/reflect.hpp"
#include "etendue/optics/refract.hpp"
#include "optics/incidence.hpp"
#include "support/evidence.hpp"

// The law of refraction as claims state it: Snell, the slab, the prism, the way back, and the errata of the formulas.
namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// atan2 of a cross product and a dot product of unit vectors: 5 u for each of the two, 2 u for the function.
constexpr double kAngleRounding = 8 * u;

// CLAIM      IU.4-6, IU.5-6: η1 sin θ = η2 sin θ', the refracted ray stays in the plane of incidence and on the far
//            side.
// ORACLE     identity: the tangential part of δ, scaled by η, is the tangential part of T, in random frames.
// TOLERANCE  refraction_error(eta) for T; 5 u (1 + eta) for the two cross products of unit vectors.
TEST(Snell, KeepsTheScaledTangentialPart) {
  proves({"IU.4-6", "IU.5-6"}, Oracle::identity, "η δ × s = T × s");
  Directions random(2201);
  int refracted = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 direction = random.unit(), s = random.unit();
    const double eta = std::exp2(random.uniform(-2, 2));
    const auto ray = refract(direction, s, eta);
    if (!ray) continue;
    ++refracted;
    EXPECT_TRUE(within((eta * direction.cross(s) - ray->cross(s)).norm(), refraction_error(eta) + 5 * u * (1 + eta)));
    EXPECT_GE(ray->dot(s) * direction.dot(s), 0);
  }
  EXPECT_GE(refracted, 5000);
}

// CLAIM      IU.4.3a: from air into glass of 1.5, 30° bend by 10.53° ("about 11°"): asin(1/2) − asin(1/3).
// ORACLE     closed form.
// TOLERANCE  refraction_error(1/1.5), the rounding of the incident direction and of the index, and that of the angle; a
//            tangential error is larger as an angle by 1/cos θ' < 1.1.
TEST(Snell, BendsThirtyDegreesByTenAndAHalf) {
  proves({"IU.4.3a", "IU.4-6"}, Oracle::closed_form, "asin(1/2) − asin(1/3)");
  Directions random(2202);
  const double expected = std::numbers::pi / 6 - std::asin(1.0 / 3);
  EXPECT_TRUE(near(expected / kDegree, 10.53, 0.005));
  for (int i = 0; i < 200; ++i) {
    const Vec3 s = random.unit();
    const Vec3 direction = random.incident(s, 0.5, std::sqrt(0.75));
    const auto ray = refract(direction, s, 1 / 1.5);
    ASSERT_TRUE(ray.has_value());
    // incident() turns rounded vectors into one another: 8 u, once for the direction and once for the angle
    EXPECT_TRUE(
        near(angle_between(direction, *ray), expected, 1.1 * refraction_error(1 / 1.5) + 16 * u + kAngleRounding));
  }
}

// CLAIM      IU.4.3b: a slab with parallel faces sends the ray on parallel to itself, displaced by
//            h sin θ (1 − cos θ / sqrt(n² − sin² θ)).
// ORACLE     closed form of the displacement.
// TOLERANCE  first-order sensitivities: the way back out multiplies an error by at most n / cos θ; the
//            displacement's by h / cos² θ' < 2.
TEST(Slab, DisplacesTheRayAndKeepsItsDirection) {
  proves({"IU.4.3b", "G14"}, Oracle::closed_form, "displacement of a plane-parallel slab");
  Directions random(2203);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 s = random.unit();
    const double n = random.uniform(1.1, 2.5), theta = random.uniform(0, 80) * kDegree;
    const Vec3 direction = random.incident(s, std::sin(theta), std::cos(theta));
    const auto inside = refract(direction, s, 1 / n);
    ASSERT_TRUE(inside.has_value());
    const auto outside = refract(*inside, s, n);
    ASSERT_TRUE(outside.has_value());
    const double back = n / std::cos(theta);  // dθ/dθ'
    const double reciprocal = 2 * u;          // 1/n is rounded: a change of sin θ'
    const double direction_error = 2 * back * (refraction_error(1 / n) + reciprocal) + refraction_error(n);
    EXPECT_TRUE(within((*outside - direction).norm(), direction_error));

    const Vec3 crossing = *inside * (-1 / inside->dot(s));
    const double displacement = crossing.cross(direction).norm();
    const double expected =
        std::sin(theta) * (1 - std::cos(theta) / std::sqrt((n - std::sin(theta)) * (n + std::sin(theta))));
    const double inside_cosine = std::sqrt(1 - std::pow(std::sin(theta) / n, 2));
    const double sensitivity = 1 / (inside_cosine * inside_cosine);
    EXPECT_TRUE(near(displacement, expected, sensitivity * (refraction_error(1 / n) + reciprocal) + 32 * u));
  }
}

// CLAIM      G14: faces that are not parallel do turn the ray: a 60° prism of 1.5 by 37.18° in the symmetric passage,
//            which is the least.
// ORACLE     closed form 2 asin(n sin(A/2)) − A.
// TOLERANCE  both refractions' bounds; the first reaches the exit multiplied by n cos 30°/cos 48.6° < 2; 32 u for the
//            construction of the prism.
TEST(Prism, TurnsTheRayByItsLeastDeviation) {
  proves({"G14", "IU.4-6"}, Oracle::closed_form, "2 asin(n sin(A/2)) − A");
  const double n = 1.5, half_apex = 30 * kDegree;
  const double entry = std::asin(n * std::sin(half_apex)), expected = 2 * entry - 2 * half_apex;
  EXPECT_TRUE(near(expected / kDegree, 37.18, 0.005));
  Directions random(2204);
  for (int i = 0; i < 500; ++i) {
    const Vec3 across = random.unit();  // from the first face to the second, parallel to the base
    const Vec3 up = random.orthogonal_to(across);
    const Vec3 first = -std::cos(half_apex) * across + std::sin(half_apex) * up;  // outward normals
    const Vec3 second = std::cos(half_apex) * across + std::sin(half_apex) * up;
    const Vec3 along = std::sin(half_apex) * across + std::cos(half_apex) * up;  // in the first face
    const auto deviation = [&](double angle) {
      const Vec3 direction = (-std::cos(angle) * first + std::sin(angle) * along).normalized();
      const auto inside = refract(direction, first, 1 / n);
      const auto outside = refract(*inside, second, n);
      return angle_between(direction, *outside);
    };
    EXPECT_TRUE(near(deviation(entry), expected, 2 * refraction_error(1 / n) + 1.6 * refraction_error(n) + 32 * u));
    EXPECT_GT(deviation(entry + kDegree), expected + 1e-4);
    EXPECT_GT(deviation(entry - kDegree), expected + 1e-4);
  }
}

// CLAIM      IU.4-6, IU.5-7: light returns on its own path: refracting back with 1/η gives −δ.
// ORACLE     metamorphic.
// TOLERANCE  refraction_error(1/eta), and that of the first refraction times the way back's derivative; cosines of at
//            least 2^-6 keep the second order out.
TEST(Refract, ReturnsAlongItsOwnPath) {
  proves({"IU.4-6", "IU.5-7"}, Oracle::metamorphic, "there and back");
  Directions random(2205);
  int returned = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 direction = random.unit(), s = random.unit();
    const double eta = std::exp2(random.uniform(-2, 2)), cosine = std::abs(direction.dot(s));
    const auto there = refract(direction, s, eta);
    if (!there || cosine < 0x1p-6) continue;
    const auto back = refract(-*there, s, 1 / eta);
    ASSERT_TRUE(back.has_value());
    const double derivative = std::max(1.0, 1 / cosine) / std::min(1.0, eta);
    const double tolerance = refraction_error(1 / eta) + 2 * derivative * (refraction_error(eta) + 2 * u);
    EXPECT_TRUE(within((*back + direction).norm(), tolerance));
    ++returned;
  }
  EXPECT_GE(returned, 5000);
}

// CLAIM      RT.18, E11: only the line of the normal matters: reversing it changes no bit.
// ORACLE     metamorphic.
// TOLERANCE  none.
TEST(Refract, IsTheSameForBothSidesOfTheNormal) {
  proves({"RT.18", "E11", "R1"}, Oracle::metamorphic, "normal reversed, bit by bit");
  Directions random(2206);
  std::uint64_t mismatches = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 direction = random.unit(), s = random.unit();
    const double eta = std::exp2(random.uniform(-2, 2));
    mismatches += refract(direction, s, eta) != refract(direction, -s, eta) ? 1U : 0U;
  }
  EXPECT_TRUE(all_agree(mismatches, 5000));
}

// CLAIM      E11: when the ray leaves the solid, N must flip in 5-7: V = (.2, 0, −.98) in glass gives T_z = −0.954 as
//            printed (back into the glass) and +0.954 mended. In 5-5 the flip does nothing.
// ORACLE     closed form: sin θ' = 1.5 · .2/|V|, T_z its cosine.
// TOLERANCE  refraction_error(1.5) and the rounding of V: a change of sin θ by u is one of T_z by η² tan θ u < u.
TEST(Refract, LeavesASolidWithTheOutwardNormal) {
  proves({"E11", "IU.5-7", "IU.5.3tir"}, Oracle::closed_form, "cosine from the sine 1.5 · 0.2/|V|");
  const Vec3 v = Vec3(0.2, 0, -0.98).normalized(), n(0, 0, 1);
  const double eta = 1.5, dot = n.dot(v);
  const Vec3 printed = eta * (n * dot - v) - n * std::sqrt(1 - eta * eta * (1 - dot * dot));
  EXPECT_TRUE(near(printed.z(), -0.954, 5e-4));
  const auto mended = refract(-v, n, eta);
  ASSERT_TRUE(mended.has_value());
  const double sine = 1.5 * 0.2 / std::sqrt(0.04 + 0.9604);
  EXPECT_TRUE(near(mended->z(), std::sqrt(1 - sine * sine), refraction_error(eta) + 4 * u));
  EXPECT_TRUE(near(mended->z(), 0.954, 5e-4));
  EXPECT_EQ(reflect(-v, n), reflect(-v, -n));
}

// CLAIM      R1: with s on the side of incidence the printed form turns normal incidence round: (0,0,+1) instead of
//            (0,0,−1). Both are unit vectors. With s on the far side it is right.
// ORACLE     exact: light that meets a surface head-on goes straight on.
// TOLERANCE  none.
TEST(Refract, GoesStraightOnAtNormalIncidence) {
  proves({"R1", "RT.18"}, Oracle::exact, "head-on light is not bent");
  const Vec3 direction(0, 0, -1);
  const auto printed = [&](const Vec3& s, double eta) {
    const double dot = direction.dot(s);
    return Vec3(eta * direction + (std::sqrt(1 - eta * eta * (1 - dot * dot)) - eta * dot) * s);
  };
  const auto mended = [&](const Vec3& s, double eta) {
    const double dot = direction.dot(s);
    return Vec3(eta * direction - (std::sqrt(1 - eta * eta * (1 - dot * dot)) + eta * dot) * s);
  };
  for (const double eta : {0.5, 0.75, 1.5}) {
    EXPECT_TRUE(within((printed(Vec3(0, 0, 1), eta) - Vec3(0, 0, 1)).norm(), 0));
    EXPECT_TRUE(within((printed(Vec3(0, 0, -1), eta) - direction).norm(), 0));
    EXPECT_TRUE(within((mended(Vec3(0, 0, 1), eta) - direction).norm(), 0));
    for (const double side : {1.0, -1.0}) {
      const auto ray = refract(direction, Vec3(0, 0, side), eta);
      ASSERT_TRUE(ray.has_value());
      EXPECT_TRUE(within((*ray - direction).norm(), 0));
    }
  }
}

// CLAIM      R2, G7, IU.5.3tir: 60° from dense to thin has the radicand −0.6875: NaN as printed, no ray in the code;
//            the light is reflected instead.
// ORACLE     exact: 1 − 2.25 · 0.75.
// TOLERANCE  none for the decision; reflection_error() and kInputRounding five times for the mirrored direction.
TEST(Refract, ReturnsNothingOnTotalInternalReflection) {
  proves({"R2", "G7", "IU.5.3tir"}, Oracle::exact, "radicand 1 − 1.5² (1 − 0.5²)");
  const double eta = 1.5, cosine = 0.5, radicand = 1 - eta * eta * (1 - cosine * cosine);
  EXPECT_EQ(radicand, -0.6875);
  EXPECT_TRUE(std::isnan(std::sqrt(radicand)));
  const Vec3 direction(std::sqrt(0.75), 0, cosine), s(0, 0, 1);  // in the solid, on the way out
  EXPECT_FALSE(refract(direction, s, eta).has_value());
  EXPECT_FALSE(refracted_cosine(direction, s, eta).has_value());
  EXPECT_TRUE(within((reflect(direction, s) - Vec3(std::sqrt(0.75), 0, -cosine)).norm(),
                     reflection_error() + 5 * kInputRounding));
}

// CLAIM      R4, RT.18: the contract of refract() is enforced.
// ORACLE     identity: the documented domain.
// TOLERANCE  none.
TEST(Refract, RefusesWhatIsNotInItsDomain) {
  proves({"R4", "RT.18"}, Oracle::identity, "the documented domain");
  const Vec3 s(0, 0, 1), direction(0, 0, -1);
  const auto at = [](const Vec3& incident, const Vec3& normal, double eta) {
    return accepted([=] { return refract(incident, normal, eta); });
  };
  EXPECT_TRUE(all_agree(at(direction, 2 * s, 1.5) + at(0.5 * direction, s, 1.5) + at(direction, s, 0) +
                            at(direction, s, -1.5) + at(direction, s, std::nan("")) + at(direction, s, 2000),
                        6));
  EXPECT_TRUE(all_agree(accepted([&] { return refracted_cosine(direction, s, 2000); }), 1));
}

}  // namespace
}  // namespace etendue::validation
