// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/plane.hpp"

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/disc.hpp"
#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Ray ray_from(const Vec3& origin, const Vec3& direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  return ray;
}

// CLAIM      IU.5-12, IU.5-13, RT.12: t = −(d + N·O)/(N·D), within kPlaneUlps, also for grazing rays and far origins.
// ORACLE     exact: the quotient in rationals.
// TOLERANCE  kPlaneUlps; the hit's own point_error and surface_error.
TEST(Plane, KeepsItsUlps) {
  proves({"IU.5-12", "IU.5-13", "RT.12"}, Oracle::exact, "the quotient in rationals");
  Random random(401);
  std::uint64_t mismatches = 0, rays = 0;
  double ulps = 0, point = 0, surface = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double far = random.scale(1, 1e6);
    const Plane plane{random.in_cube(far), random.unit_vector()};
    const double grazing = random.scale(1e-14, 1);
    const Vec3 within = plane.normal.cross(random.unit_vector()).normalized();
    const Ray ray = ray_from(random.in_cube(far), random.scale(1e-3, 1e3) * (within - grazing * plane.normal));
    const auto truth =
        oracle::plane_parameter(exact(ray.origin), exact(ray.direction), exact(plane.point), exact(plane.normal));
    ASSERT_TRUE(truth);
    const auto hit = intersect(ray, plane);
    ++rays;
    mismatches += hit.has_value() != (truth->high > 0);
    if (!hit) continue;
    ulps = std::max(ulps, oracle::ulps(hit->t, *truth));
    point = std::max(point, oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), *truth) /
                                hit->point_error);
    surface = std::max(surface, oracle::distance_to_plane(exact(hit->point), exact(plane.point), exact(plane.normal)) /
                                    hit->surface_error);
  }
  EXPECT_TRUE(all_agree(mismatches, rays));
  EXPECT_TRUE(within(ulps, kPlaneUlps));
  EXPECT_TRUE(within(point, 1));
  EXPECT_TRUE(within(surface, 1));
}

// CLAIM      IU.5-13, RT.12: a ray exactly parallel to the plane, or in it, is a miss; t ≤ 0 and t ≥ the nearest so far
//            too.
// ORACLE     closed form: integer vectors, every number exact.
// TOLERANCE  none.
TEST(Plane, RejectsParallelBehindAndFarther) {
  proves({"IU.5-13", "RT.12", "IU.5-1", "RT.2"}, Oracle::closed_form, "integer vectors");
  // |(2, 3, 6)| = 7: a unit normal that is almost (2, 3, 6)/7, and directions with N·D = 0 exactly by antisymmetry.
  const Plane plane{{1, 2, 3}, Vec3(2, 3, 6) / 7};
  const Vec3 n = plane.normal;
  EXPECT_TRUE(holds(!intersect(ray_from({5, 5, 5}, {n.y(), -n.x(), 0}), plane)));
  EXPECT_TRUE(holds(!intersect(ray_from(plane.point, {0, n.z(), -n.y()}), plane)));
  EXPECT_TRUE(holds(!intersect(ray_from(plane.point, n), plane))) << "an origin on the plane is not hit at t = 0";
  const Plane floor{Vec3::Zero(), Vec3::UnitZ()};
  EXPECT_TRUE(holds(!intersect(ray_from({0, 0, 1}, {0, 0, 1}), floor))) << "behind";
  Ray ray = ray_from({1, 2, 4}, {0.5, 0, -2});
  const auto hit = intersect(ray, floor);
  ASSERT_TRUE(hit);
  EXPECT_TRUE(near(hit->t, 2, 0));
  EXPECT_TRUE(holds(hit->point == Vec3(2, 2, 0)));
  EXPECT_TRUE(holds(hit->point == ray.at(2)));
  ray.t_max = 2;
  EXPECT_TRUE(holds(!intersect(ray, floor))) << "not nearer than the nearest so far";
  ray.t_max = 2.0000000000000004;
  EXPECT_TRUE(holds(intersect(ray, floor).has_value()));
  ray.t_min = 2;
  EXPECT_TRUE(holds(!intersect(ray, floor))) << "t_min is not part of the range";
}

// CLAIM      The contract: a direction that is zero, or a normal that is no unit vector, is refused and not answered.
// ORACLE     identity: the documented precondition.
// TOLERANCE  none.
TEST(Plane, RefusesBrokenInput) {
  proves({"IU.5-12"}, Oracle::identity, "documented preconditions");
  const Plane floor{Vec3::Zero(), Vec3::UnitZ()}, wrong{Vec3::Zero(), Vec3(0, 0, 2)};
  EXPECT_TRUE(refuses([&] { (void)intersect(ray_from({0, 0, 1}, Vec3::Zero()), floor); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray_from({0, 0, 1}, {0, 0, -1}), wrong); }));
}

// CLAIM      IU.5.0: a disc is hit where its plane is, within the radius.
// ORACLE     exact: the meeting with the plane in rationals, its distance from the centre.
// TOLERANCE  a decision may differ only where the rim is nearer than the hit's point_error; t within kPlaneUlps.
TEST(Disc, IsHitWithinItsRadius) {
  proves({"IU.5.0"}, Oracle::exact, "the meeting with the plane in rationals");
  Random random(402);
  std::uint64_t mismatches = 0, rays = 0, hits = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Disc disc{random.in_cube(100), random.unit_vector(), random.scale(0.01, 10)};
    const Vec3 aside = disc.normal.cross(random.unit_vector()).normalized();
    // Half of the rays are aimed at the rim, 2^-20 … 2^-60 inside or outside.
    const double rim = 1 + std::ldexp(random.uniform(-1, 1), -20 - static_cast<int>(random.index(40)));
    const double reach = i % 2 ? rim : random.uniform(0, 2);
    Ray ray;
    ray.origin = disc.centre + random.in_cube(20);
    ray.direction = disc.centre + reach * disc.radius * aside - ray.origin;
    const auto truth =
        oracle::plane_parameter(exact(ray.origin), exact(ray.direction), exact(disc.centre), exact(disc.normal));
    ASSERT_TRUE(truth);
    const double distance = oracle::distance_along(exact(disc.centre), exact(ray.origin), exact(ray.direction), *truth);
    const auto hit = intersect(ray, disc);
    const auto whole = intersect(ray, Plane{disc.centre, disc.normal});
    ASSERT_TRUE(whole);
    // The comparison of the squares rounds twice more.
    const double doubt = whole->point_error + 4 * kUnitRoundoff * disc.radius;
    if (std::abs(distance - disc.radius) > doubt) {
      ++rays;
      mismatches += hit.has_value() != (distance < disc.radius);
    }
    if (!hit) continue;
    ++hits;
    EXPECT_LE(oracle::ulps(hit->t, *truth), kPlaneUlps);
    EXPECT_TRUE(within(std::abs(hit->uv.norm() - distance / disc.radius), 2 * doubt / disc.radius + 8 * kUnitRoundoff));
  }
  EXPECT_GT(hits, 5'000u);
  EXPECT_TRUE(all_agree(mismatches, rays));
}

}  // namespace
}  // namespace etendue::validation
