// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/sphere.hpp"

#include <cmath>

#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

oracle::Roots exact_roots(const Ray& ray, const Sphere& sphere) {
  return oracle::sphere_roots(exact(ray.origin), exact(ray.direction), exact(sphere.centre), sphere.radius);
}

// The smallest positive root, if the line meets the sphere in two points.
std::optional<oracle::Wide> exact_first(const oracle::Roots& roots) {
  if (roots.discriminant <= 0) return std::nullopt;
  if (roots.near.high > 0) return roots.near;
  if (roots.far.high > 0) return roots.far;
  return std::nullopt;
}

// Rays from `distance` radii that pass the centre at `aside` radii.
Ray ray_past(const Sphere& sphere, double distance, double aside, Random& random) {
  const Vec3 away = random.unit_vector(), sideways = away.cross(random.unit_vector()).normalized();
  Ray ray;
  ray.origin = sphere.centre + distance * sphere.radius * away;
  ray.direction = (sphere.centre + aside * sphere.radius * sideways - ray.origin) * random.scale(1e-3, 1e3);
  return ray;
}

struct Tally {
  std::uint64_t mismatches = 0, decisions = 0, hits = 0;
  double worst_ulps = 0, worst_point = 0, worst_surface = 0;
};

// `origin_share`: size of the centre's coordinates against the radius.
void compare(const Ray& ray, const Sphere& sphere, Tally& tally) {
  const auto truth = exact_first(exact_roots(ray, sphere));
  const auto hit = intersect(ray, sphere);
  ++tally.decisions;
  tally.mismatches += hit.has_value() != truth.has_value();
  if (!hit || !truth) return;
  ++tally.hits;
  tally.worst_ulps = std::max(tally.worst_ulps, oracle::ulps(hit->t, *truth));
  const double gap = oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), *truth);
  tally.worst_point = std::max(tally.worst_point, gap / hit->point_error);
  const double height = oracle::distance_to_sphere(exact(hit->point), exact(sphere.centre), sphere.radius);
  tally.worst_surface = std::max(tally.worst_surface, height / hit->surface_error);
}

void expect_sound(const Tally& tally) {
  EXPECT_GT(tally.hits, tally.decisions / 10);
  EXPECT_TRUE(all_agree(tally.mismatches, tally.decisions));
  EXPECT_TRUE(within(tally.worst_ulps, kSphereUlps));
  EXPECT_TRUE(within(tally.worst_point, 1));
  EXPECT_TRUE(within(tally.worst_surface, 1));
}

// CLAIM      IU.5-8 … IU.5-11, RT.8: hit or miss is decided exactly and t keeps kSphereUlps from 1 to 10⁶ radii away.
// ORACLE     exact: discriminant in rationals, roots at 1000 bits.
// TOLERANCE  kSphereUlps; the hit's own point_error and surface_error.
TEST(Sphere, KeepsItsUlpsFromAnyDistance) {
  proves({"IU.5-8", "IU.5-9", "IU.5-10", "IU.5-11", "RT.8"}, Oracle::exact,
         "rational discriminant, roots at 1000 bits");
  Random random(201);
  Tally tally;
  for (int i = 0; i < 20'000; ++i) {
    const Sphere sphere{random.in_cube(10), random.scale(1e-3, 1e3)};
    compare(ray_past(sphere, random.scale(1.0001, 1e6), random.uniform(0, 1.2), random), sphere, tally);
  }
  expect_sound(tally);
}

// CLAIM      IU.5-11: the same where the ray grazes the sphere, within 2^-1 … 2^-60 radii of its silhouette.
// ORACLE     exact, as above.
// TOLERANCE  as above; both outcomes must occur, so the silhouette was really straddled.
TEST(Sphere, KeepsItsUlpsAtTheSilhouette) {
  proves({"IU.5-11"}, Oracle::exact, "rational discriminant, roots at 1000 bits");
  Random random(202);
  Tally tally;
  for (int i = 0; i < 20'000; ++i) {
    const Sphere sphere{random.in_cube(3), random.scale(0.1, 10)};
    const double offset = std::ldexp(random.bits() % 2 ? 1.0 : -1.0, -1 - static_cast<int>(random.index(60)));
    const double distance = random.scale(1.0001, 1e6);
    // A line at distance b from the centre through a point at distance d is aimed at b / sqrt(1 − b²/d²) beside it.
    const double b = 1 + offset / 4;
    if (b >= distance) continue;
    compare(ray_past(sphere, distance, b / std::sqrt(1 - b * b / (distance * distance)), random), sphere, tally);
  }
  EXPECT_LT(tally.hits, tally.decisions * 9 / 10);
  expect_sound(tally);
}

// CLAIM      IU.5-11: the same for origins inside, and within rounding of the surface on either side.
// ORACLE     exact, as above.
// TOLERANCE  as above.
TEST(Sphere, KeepsItsUlpsFromInsideAndFromTheSurface) {
  proves({"IU.5-11", "E14"}, Oracle::exact, "rational discriminant, roots at 1000 bits");
  Random random(203);
  Tally tally;
  for (int i = 0; i < 20'000; ++i) {
    const Sphere sphere{random.in_cube(3), random.scale(0.1, 10)};
    const double depth = i % 2 ? random.uniform(0, 1) : 1 + std::ldexp(random.uniform(-1, 1), -45);
    Ray ray;
    ray.origin = sphere.centre + depth * sphere.radius * random.unit_vector();
    ray.direction = random.in_cube(1);
    compare(ray, sphere, tally);
  }
  expect_sound(tally);
}

// CLAIM      IU.5-11, E14: the same where DoubleDouble runs out of digits: a sphere that touches the coordinates'
//            origin, rays from beside that point, where doubles are as fine as 2^-110 and c = λ − R² is as small,
//            mostly along the surface.
// ORACLE     exact, as above.
// TOLERANCE  as above; both sides of the surface must occur.
TEST(Sphere, KeepsItsUlpsWhereOnlyExactNumbersTell) {
  proves({"IU.5-11", "E14"}, Oracle::exact, "rational discriminant, roots at 1000 bits");
  Random random(207);
  Tally tally;
  std::uint64_t outside = 0;
  for (int i = 0; i < 5'000; ++i) {
    const double radius = random.scale(0.1, 10);
    const Sphere touching{{radius, 0, 0}, radius};
    const double y = random.scale(1e-12, 1e-6), z = random.scale(1e-12, 1e-6);
    const double depth = (y * y + z * z) / (2 * radius);
    Ray ray;
    ray.origin = {depth * (1 + 0x1p-52 * std::round(random.uniform(-3, 3))), y, z};
    ray.direction = {random.scale(1e-18, 1) * (random.bits() % 2 ? 1 : -1), random.uniform(-1, 1),
                     random.uniform(-1, 1)};
    outside += exact_roots(ray, touching).origin_side > 0;
    compare(ray, touching, tally);
  }
  EXPECT_GT(outside, 1'000u);
  EXPECT_LT(outside, 4'000u);
  expect_sound(tally);
}

// CLAIM      G15: μ − √γ loses 10⁶ to 10⁷ ulp at a million radii; intersect() keeps kSphereUlps there.
// ORACLE     exact, as above.
// TOLERANCE  the printed form must be worse than 10⁶ ulp; ours kSphereUlps.
TEST(Sphere, OutlivesTheCancellationOfThePrintedFormula) {
  proves({"G15", "IU.5-11"}, Oracle::exact, "roots at 1000 bits");
  Random random(204);
  double printed_worst = 0, worst = 0;
  for (int i = 0; i < 2'000; ++i) {
    const Sphere sphere{random.in_cube(1), 1};
    Ray ray = ray_past(sphere, 1e6, random.uniform(0, 0.999), random);
    ray.direction.normalize();
    const auto truth = exact_first(exact_roots(ray, sphere));
    ASSERT_TRUE(truth);
    const Vec3 t = sphere.centre - ray.origin;
    const double mu = ray.direction.dot(t), gamma = mu * mu - t.dot(t) + sphere.radius * sphere.radius;
    printed_worst = std::max(printed_worst, oracle::ulps(mu - std::sqrt(gamma), *truth));
    const auto hit = intersect(ray, sphere);
    ASSERT_TRUE(hit);
    worst = std::max(worst, oracle::ulps(hit->t, *truth));
  }
  RecordProperty("printed_form_ulps", std::to_string(printed_worst));
  EXPECT_GT(printed_worst, 1e6);
  EXPECT_TRUE(within(worst, kSphereUlps));
}

// CLAIM      IU.5-11, R9: a tangent (γ = 0 exactly) counts as a miss, from any side and in any place.
// ORACLE     exact: the generator asserts that the rational discriminant is zero.
// TOLERANCE  none.
TEST(Sphere, IsMissedByATangent) {
  proves({"IU.5-11", "RT.8", "R9"}, Oracle::exact, "the rational discriminant is 0");
  Random random(205);
  std::uint64_t hits = 0, tangents = 0;
  while (tangents < 2'000) {
    // Pythagorean quadruples keep everything rational: |(1, 2, 2)| = 3.
    const Vec3 radius(1, 2, 2), along(2, -2, 1), third(2, 1, -2);
    const Vec3 sideways = along * std::round(random.uniform(-8, 8)) + third * std::round(random.uniform(-8, 8));
    if (sideways.isZero()) continue;
    const Sphere sphere{random.dyadic(1000, 10), 3};
    Ray ray;
    ray.direction = sideways;
    ray.origin = sphere.centre + radius - sideways * std::round(random.uniform(1, 1e4));
    ASSERT_EQ(exact_roots(ray, sphere).discriminant, 0);
    hits += intersect(ray, sphere).has_value();
    ++tangents;
  }
  EXPECT_TRUE(all_agree(hits, tangents));
}

// CLAIM      E14: an origin on the sphere does not hit at t = 0; printed, t = μ + √γ = 0 for O = D = (1, 0, 0). R8: a ray is the open
//            half-line t > 0; over [0, ∞), as one slide has it, a ray from a surface meets that surface where it begins.
// ORACLE     closed form: the chord of the unit sphere.
// TOLERANCE  none: every number is exact.
TEST(Sphere, IsNotHitAtTheOriginOfTheRay) {
  proves({"E14", "R8"}, Oracle::closed_form, "chords of the unit sphere");
  const Sphere unit{Vec3::Zero(), 1};
  const auto from = [](const Vec3& origin, const Vec3& direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return ray;
  };
  const double mu = -1, gamma = mu * mu - 1 + 1;
  EXPECT_EQ(mu + std::sqrt(gamma), 0) << "the printed rule answers t = 0";
  EXPECT_TRUE(holds(!intersect(from({1, 0, 0}, {1, 0, 0}), unit)));
  EXPECT_TRUE(holds(!intersect(from({1, 0, 0}, {0, 1, 0}), unit)));
  const auto through = intersect(from({1, 0, 0}, {-1, 0, 0}), unit);
  ASSERT_TRUE(through);
  EXPECT_TRUE(near(through->t, 2, 0));
  EXPECT_TRUE(holds(through->normal == Vec3(-1, 0, 0)));
}

// CLAIM      G16: a tangent is not "without meaning": it is where the two meetings fall together, at t = μ, an intersection of
//            multiplicity two. The meetings on either side of it close in on μ like the root of what is left of the distance.
// ORACLE     closed form: γ = R² − b² for a ray at the distance b from the centre; all numbers dyadic, μ = 8.
// TOLERANCE  kSphereUlps of t, and one rounding of √γ.
TEST(Sphere, HasATangentWhereTwoMeetingsFallTogether) {
  proves({"G16", "IU.5-11"}, Oracle::closed_form, "γ = R² − b²");
  const Sphere unit{Vec3::Zero(), 1};
  for (int e = 2; e <= 52; e += 2) {
    const double b = 1 - std::ldexp(1.0, -e), left = std::ldexp(1.0, -e);
    const double half_chord = std::sqrt(left * (2 - left));  // γ = (1 − b)(1 + b)
    Ray ray;
    ray.origin = {-8, b, 0};
    ray.direction = {1, 0, 0};
    const auto enters = intersect(ray, unit);
    ASSERT_TRUE(enters);
    ray.t_min = 8;  // between the two
    const auto leaves = intersect(ray, unit);
    ASSERT_TRUE(leaves);
    const double tolerance = (kSphereUlps * 16 + 2) * 0x1p-53;
    EXPECT_TRUE(near(enters->t, 8 - half_chord, tolerance));
    EXPECT_TRUE(near(leaves->t, 8 + half_chord, tolerance));
    EXPECT_TRUE(within((enters->normal - leaves->normal).norm(), 2 * half_chord + 0x1p-50));
  }
}

// CLAIM      E15, IU.5-10: with μ ≤ 0 the intersections lie behind the origin (not beyond it): outside is a miss.
// ORACLE     identity: r(t) = O + tD has its two meetings at t < 0.
// TOLERANCE  none.
TEST(Sphere, BehindTheOriginIsAMiss) {
  proves({"E15", "IU.5-10", "IU.5-1"}, Oracle::exact, "signs of both rational roots");
  Random random(206);
  std::uint64_t hits = 0, rays = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Sphere sphere{random.in_cube(5), random.scale(0.1, 10)};
    Ray ray = ray_past(sphere, random.scale(1.01, 100), random.uniform(0, 0.9), random);
    ray.direction = -ray.direction;
    const auto roots = exact_roots(ray, sphere);
    ASSERT_TRUE(roots.discriminant > 0 && roots.far.high < 0);
    hits += intersect(ray, sphere).has_value();
    ++rays;
  }
  EXPECT_TRUE(all_agree(hits, rays));
}

// CLAIM      RT.19, RT.8: exercise 1, a ray from (1, 5, 4) along (1, −1, 0) is tangent to the sphere of centre (2, 2,
//            4) and radius √2; exercise 2, a ray from (3, 2, −1) along (1, 2, 1) is tangent to the one of centre (5, 3,
//            1), radius √3.
// ORACLE     closed form: by hand; (7p − q)(p + q) = 0 for directions (p, q, 0); (1, −1, 1) ⟂ (1, 2, 1) at t = 1.
// TOLERANCE  one unit in the last place of the radius: the sphere just above the root is hit, the one below is not.
TEST(Sphere, AnswersTheExercisesOfTheLecture) {
  proves({"RT.19", "RT.8"}, Oracle::closed_form, "tangents by hand");
  const auto straddles = [](const Vec3& origin, const Vec3& direction, const Vec3& centre, double square) {
    double above = std::sqrt(square);
    if (std::fma(above, above, -square) < 0) above = std::nextafter(above, 10);
    const double below = std::nextafter(above, 0);
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    const auto hit = intersect(ray, Sphere{centre, above});
    return hit && !intersect(ray, Sphere{centre, below}) ? hit->t : -1;
  };
  // Half the chord of a sphere one unit in the last place too large: √(2 R ulp) < 2^-24.
  constexpr double kHalfChord = 0x1p-24;
  EXPECT_TRUE(near(straddles({1, 5, 4}, {1, -1, 0}, {2, 2, 4}, 2), 2, kHalfChord));
  EXPECT_TRUE(near(straddles({1, 5, 4}, {-1, -7, 0}, {2, 2, 4}, 2), 0.4, kHalfChord));
  EXPECT_TRUE(near(straddles({3, 2, -1}, {1, 2, 1}, {5, 3, 1}, 3), 1, kHalfChord));
}

}  // namespace
}  // namespace etendue::validation
