// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/torus.hpp"

#include <cmath>

#include "etendue/geometry/spawn.hpp"
#include "geometry/crossings.hpp"
#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "oracles/line_roots.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

oracle::LineRoots roots_of(const Ray& ray, const Torus& torus) {
  return oracle::torus_roots(exact(ray.origin), exact(ray.direction), exact(torus.centre), exact(torus.axis),
                             torus.ring, torus.tube);
}

Torus random_torus(Random& random) {
  const Vec3 centre = random.in_cube(100), axis = random.unit_vector() * random.scale(0.1, 10);
  const double ring = random.scale(0.1, 10), share = random.uniform(0.01, 0.99);
  return {centre, axis, ring, ring * (random.index(4) == 0 ? random.scale(1 / kThinnestTorus, 0.01) : share)};
}

double distance_from(const Torus& torus, const Vec3& point) {
  const Vec3 axis = torus.axis.normalized(), x = point - torus.centre;
  const Vec3 radial = (x - axis.dot(x) * axis).normalized();
  return std::abs((x - torus.ring * radial).norm() - torus.tube);
}

// A third grazes the tube, 2^-1 … 2^-30 of its radius inside or outside; a fifth begins inside.
Ray aimed_ray(Random& random, const Torus& torus, int i) {
  const Vec3 axis = torus.axis.normalized(), side = axis.cross(random.unit_vector()).normalized();
  const Vec3 middle = torus.centre + torus.ring * side;
  const double turn = random.uniform(0, 6.3);
  const Vec3 outward = (std::cos(turn) * side + std::sin(turn) * axis).normalized();
  const bool grazes = i % 3 == 0;
  const double halvings = 1 + static_cast<double>(random.index(30));
  const double aside = grazes ? 1 + random.uniform(-1, 1) * std::exp2(-halvings) : random.uniform(0, 1.2);
  const Vec3 target = middle + aside * torus.tube * outward, any = random.unit_vector();
  const Vec3 along = grazes ? outward.cross(any).normalized() : any;
  Ray ray;
  ray.origin = target - along * random.scale(0.1, 1e4) * torus.ring;
  if (i % 5 == 0) ray.origin = middle + 0.5 * torus.tube * random.unit_vector();
  ray.direction = (target - ray.origin) * random.scale(0.1, 10);
  return ray;
}

// CLAIM      IU.5.0: a torus in any place is hit where and when the exact quartic says, from outside and inside, from
//            afar and by grazing rays; up to four crossings are told apart.
// ORACLE     exact: the quartic with rational coefficients; its roots isolated by Arb, counted by Sturm's sequence.
// TOLERANCE  kTorusUlps for t; the hit's own point_error; decisions none.
TEST(Torus, IsHitAsTheExactQuarticSays) {
  proves({"IU.5.0"}, Oracle::exact, "rational quartic, Sturm's sequence, isolated roots");
  uses_seed(811);
  Random random(811);
  std::uint64_t mismatches = 0, rays = 0, hits = 0, four = 0;
  double ulps = 0, point = 0, surface = 0;
  const std::uint64_t cases = long_run(2'000);
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Torus torus = random_torus(random);
    const Ray ray = aimed_ray(random, torus, static_cast<int>(i));
    const oracle::LineRoots roots = roots_of(ray, torus);
    ASSERT_EQ(roots.changes.size(), static_cast<std::size_t>(roots.distinct)) << "Arb finds what Sturm counts";
    std::optional<oracle::Wide> truth;
    for (const oracle::Wide& t : roots.changes) {
      if (!truth && t.high > 0) truth = t;
    }
    const auto hit = intersect(ray, torus);
    ++rays;
    four += roots.distinct == 4;
    mismatches += hit.has_value() != truth.has_value();
    if (!hit || !truth) continue;
    ++hits;
    ulps = std::max(ulps, oracle::ulps(hit->t, *truth));
    point = std::max(point, oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), *truth) /
                                hit->point_error);
    surface = std::max(surface, distance_from(torus, hit->point) / hit->surface_error);
  }
  EXPECT_GT(hits, rays / 2);
  EXPECT_GT(four, rays / 20);
  EXPECT_TRUE(all_agree(mismatches, rays));
  EXPECT_TRUE(within(ulps, kTorusUlps));
  EXPECT_TRUE(within(point, 1));
  // The distance above is itself rounded: a few u of coordinates, which surface_error counts twice.
  EXPECT_TRUE(within(surface, 1));
}

// CLAIM      IU.5.0: also from afar the first crossing is found where the torus is widest, at its outermost circle.
// ORACLE     exact: the quartic with rational coefficients; its roots isolated by Arb.
// TOLERANCE  kTorusUlps for t; the hit's own point_error; decisions none.
TEST(Torus, IsHitFromAfarWhereItIsWidest) {
  proves({"IU.5.0"}, Oracle::exact, "rational quartic, isolated roots, from 1e4 to 2^40 ring radii away");
  uses_seed(814);
  Random random(814);
  std::uint64_t mismatches = 0, rays = 0;
  double ulps = 0, point = 0;
  for (int i = 0; i < 2'000; ++i) {
    Torus torus = random_torus(random);
    torus.tube = torus.ring * random.uniform(0.01, 0.99);  // the domain from afar
    const Vec3 outward = torus.axis.cross(random.unit_vector()).normalized();
    const Vec3 target = torus.centre + (torus.ring + torus.tube) * outward;
    Ray ray;
    ray.origin = target + random.scale(1e4, 0x1p40) * torus.ring * (outward + 0.3 * random.unit_vector()).normalized();
    ray.direction = (target - ray.origin) * random.scale(0.1, 10);
    std::optional<oracle::Wide> truth;
    for (const oracle::Wide& t : roots_of(ray, torus).changes) {
      if (!truth && t.high > 0) truth = t;
    }
    const auto hit = intersect(ray, torus);
    ++rays;
    mismatches += hit.has_value() != truth.has_value();
    if (!hit || !truth) continue;
    ulps = std::max(ulps, oracle::ulps(hit->t, *truth));
    point = std::max(point, oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), *truth) /
                                hit->point_error);
  }
  EXPECT_TRUE(all_agree(mismatches, rays));
  EXPECT_TRUE(within(ulps, kTorusUlps));
  EXPECT_TRUE(within(point, 1));
}

// CLAIM      IU.5.0: every crossing of a line is found, one after the other, and none that is not there; each point lies on
//            the torus.
// ORACLE     exact: the number of sign changes by Sturm's sequence.
// TOLERANCE  1e-12 max(1, way of the ray) off the surface: surface_error is u (2|p|_1 + 32 (R + r)) < 1e-13 for the |p|_1 <
//            350 and R + r < 20 met here, and the test's own distance errs as little; counts none.
TEST(Torus, CountsItsCrossingsAsSturmDoes) {
  proves({"IU.5.0"}, Oracle::exact, "Sturm's sequence of the rational quartic");
  uses_seed(812);
  Random random(812);
  const std::uint64_t cases = long_run(20'000);
  std::uint64_t wrong = 0, lines = 0, counts[5] = {};
  double off = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Torus torus = random_torus(random);
    const Ray ray = aimed_ray(random, torus, static_cast<int>(i));
    const long truth = oracle::torus_crossings(exact(ray.origin), exact(ray.direction), exact(torus.centre),
                                               exact(torus.axis), torus.ring, torus.tube);
    const Crossings found = crossings(ray, torus, 4, [&](const Vec3& point) { return distance_from(torus, point); });
    ++lines;
    wrong += found.count != truth;
    ++counts[std::min(found.count, 4L)];
    off = std::max(off, found.off);
  }
  for (const std::uint64_t count : counts) EXPECT_GT(count, 0U) << "0 to 4 crossings all occur";
  EXPECT_TRUE(all_agree(wrong, lines));
  EXPECT_TRUE(within(off, 1e-12));
}

// CLAIM      IU.5.0: a tangent is a miss, the hole is open, an origin on the surface is not hit at 0, normals point
//            outward also from inside, u and v count turns.
// ORACLE     closed form: the torus of radii 2 and 1 around z.
// TOLERANCE  none; u and v to 2^-50 (one arc tangent).
TEST(Torus, IsTheTubeAroundARing) {
  proves({"IU.5.0"}, Oracle::closed_form, "the torus of radii 2 and 1 around z");
  const Torus torus{Vec3::Zero(), {0, 0, 3}, 2, 1};
  const auto hit = [&](const Vec3& origin, const Vec3& direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return intersect(ray, torus);
  };
  const auto outer = hit({5, 0, 0}, {-1, 0, 0});
  ASSERT_TRUE(outer);
  EXPECT_TRUE(holds(outer->t == 2 && outer->normal == Vec3(1, 0, 0) && outer->uv == Vec2(0, 0)));
  const auto top = hit({0, 2, 4}, {0, 0, -2});
  ASSERT_TRUE(top);
  EXPECT_TRUE(holds(top->t == 1.5 && top->normal == Vec3(0, 0, 1)));
  EXPECT_TRUE(within((top->uv - Vec2(0.25, 0.25)).norm(), 0x1p-50));
  EXPECT_TRUE(holds(!hit({0, 0, 5}, {0, 0, -1}))) << "through the hole";
  EXPECT_TRUE(holds(!hit({2, -5, 1}, {0, 1, 0}))) << "tangent along the top";
  EXPECT_TRUE(holds(!hit({3, -5, 0}, {0, 1, 0}))) << "tangent to the outermost circle";
  EXPECT_TRUE(holds(!hit({0, 0, 3}, {1, 0, 0}))) << "over it";
  const auto inside = hit({2, 0, 0}, {0, 0, 1});
  ASSERT_TRUE(inside);
  EXPECT_TRUE(holds(inside->t == 1 && inside->normal == Vec3(0, 0, 1)));
  const auto from_surface = hit({3, 0, 0}, {-1, 0, 0});
  ASSERT_TRUE(from_surface) << "from the outermost circle inward";
  EXPECT_TRUE(holds(from_surface->t == 2 && from_surface->normal == Vec3(-1, 0, 0)));
  EXPECT_TRUE(holds(!hit({3, 0, 0}, {1, 0, 0})));
}

// CLAIM      IU.5.4b: a ray that starts at a hit's offset origin does not meet the same place of a torus again.
// ORACLE     metamorphic: from a point outside a torus, the way straight outward is free.
// TOLERANCE  none.
TEST(Torus, LetsSpawnedRaysGo) {
  proves({"IU.5.4b"}, Oracle::metamorphic, "the way along the outward normal of the outermost half is free");
  uses_seed(813);
  Random random(813);
  std::uint64_t caught = 0, rays = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Torus torus = random_torus(random);
    const auto hit = intersect(aimed_ray(random, torus, i), torus);
    if (!hit) continue;
    const Vec3 axis = torus.axis.normalized(), x = hit->point - torus.centre, radial = x - axis.dot(x) * axis;
    if (radial.norm() < torus.ring) continue;  // the inner half looks at the other side of the ring
    Ray ray;
    ray.origin = offset_origin(*hit, hit->normal);
    ray.direction = hit->normal;
    ++rays;
    caught += intersect(ray, torus).has_value();
  }
  EXPECT_GT(rays, 3000U);
  EXPECT_TRUE(all_agree(caught, rays));
}

// CLAIM      a torus without a hole, without an axis or not finite is refused.
// ORACLE     closed form: the domain.
// TOLERANCE  none.
TEST(Torus, RefusesWhatIsNone) {
  proves({}, Oracle::closed_form, "the domain as documented");
  const Ray ray;
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Torus{Vec3::Zero(), Vec3::UnitZ(), 1, 1}); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Torus{Vec3::Zero(), Vec3::UnitZ(), 1, 0}); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Torus{Vec3::Zero(), Vec3::Zero(), 2, 1}); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Torus{Vec3(0, NAN, 0), Vec3::UnitZ(), 2, 1}); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Torus{Vec3::Zero(), Vec3::UnitZ(), INFINITY, 1}); }));
}

}  // namespace
}  // namespace etendue::validation
