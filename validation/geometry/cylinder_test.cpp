// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/cylinder.hpp"

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// Height of the line's point at t over the base, in units of the axis; to a few u of the terms.
double height_at(const Ray& ray, const Cylinder& cylinder, double t) {
  const Vec3 axis = cylinder.top - cylinder.base;
  return (ray.origin - cylinder.base + t * ray.direction).dot(axis) / axis.squaredNorm();
}

// CLAIM      IU.5.0: a finite cylinder in any frame is hit where and when the exact quadratic says, from outside and
//            inside, also by grazing rays.
// ORACLE     exact: the quadratic of the infinite cylinder in rationals, roots at 1000 bits.
// TOLERANCE  kCylinderUlps for t; the hit's own point_error; decisions are open where a root's height is within 2^-40
//            of an end (the test's own height is only double), and nowhere else.
TEST(Cylinder, IsHitAsTheExactQuadraticSays) {
  proves({"IU.5.0"}, Oracle::exact, "rational quadratic, roots at 1000 bits");
  constexpr double kEnd = 0x1p-40;
  Random random(801);
  std::uint64_t mismatches = 0, rays = 0, hits = 0;
  double ulps = 0, point = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 base = random.in_cube(100), along = random.unit_vector() * random.scale(0.1, 10);
    const Cylinder cylinder{base, base + along, random.scale(0.01, 1)};
    const Vec3 sideways = along.cross(random.unit_vector()).normalized();
    // A third starts inside; a third grazes the wall, 2^-1 … 2^-30 radii inside or outside.
    const double graze = 1 + std::ldexp(random.uniform(-1, 1), -1 - static_cast<int>(random.index(30)));
    const double aside = i % 3 == 0 ? graze : random.uniform(0, 1.2);
    Ray ray;
    ray.origin = base + random.uniform(0, 1) * along +
                 (i % 3 == 1 ? 0.9 * cylinder.radius : random.scale(1.1, 1e4) * cylinder.radius) *
                     along.cross(sideways).normalized();
    ray.direction = base + random.uniform(-0.2, 1.2) * along + aside * cylinder.radius * sideways - ray.origin;
    const auto roots = oracle::cylinder_roots(exact(ray.origin), exact(ray.direction), exact(cylinder.base),
                                              exact(cylinder.top), cylinder.radius);
    std::optional<oracle::Wide> truth;
    bool open = false;
    if (roots.discriminant > 0) {
      for (const auto& t : {roots.near, roots.far}) {
        const double height = height_at(ray, cylinder, t.high);
        open = open || std::min(std::abs(height), std::abs(height - 1)) < kEnd;
        if (!truth && t.high > 0 && height >= 0 && height <= 1) truth = t;
      }
    }
    if (open) continue;
    const auto hit = intersect(ray, cylinder);
    ++rays;
    mismatches += hit.has_value() != truth.has_value();
    if (!hit || !truth) continue;
    ++hits;
    ulps = std::max(ulps, oracle::ulps(hit->t, *truth));
    point = std::max(point, oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), *truth) /
                                hit->point_error);
  }
  EXPECT_GT(hits, rays / 4);
  EXPECT_TRUE(all_agree(mismatches, rays));
  EXPECT_TRUE(within(ulps, kCylinderUlps));
  EXPECT_TRUE(within(point, 1));
}

// CLAIM      IU.5.0: the ends are open, a tangent and a ray along the axis are misses, an origin on the wall is not hit
//            at 0.
// ORACLE     closed form: the unit cylinder around z from 0 to 2.
// TOLERANCE  none.
TEST(Cylinder, IsOnlyItsWall) {
  proves({"IU.5.0"}, Oracle::closed_form, "the unit cylinder around z");
  const Cylinder wall{{0, 0, 0}, {0, 0, 2}, 1};
  const auto hit = [&](const Vec3& origin, const Vec3& direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return intersect(ray, wall);
  };
  const auto through = hit({-3, 0, 1}, {1, 0, 0});
  ASSERT_TRUE(through);
  EXPECT_TRUE(holds(through->t == 2));
  EXPECT_TRUE(holds(through->normal == Vec3(-1, 0, 0)));
  EXPECT_TRUE(holds(through->uv.y() == 0.5));
  EXPECT_TRUE(holds(!hit({0, 0, -1}, {0, 0, 1}))) << "along the axis, through the open ends";
  EXPECT_TRUE(holds(!hit({0.5, 0, 5}, {0, 0, -1}))) << "parallel to the axis";
  EXPECT_TRUE(holds(!hit({-3, 1, 1}, {1, 0, 0}))) << "tangent";
  EXPECT_TRUE(holds(!hit({-3, 0, 2.5}, {1, 0, 0}))) << "over the top";
  const auto inner = hit({-3, 0, 4}, {1, 0, -0.75});
  ASSERT_TRUE(inner) << "in through the open top, on to the far wall";
  EXPECT_TRUE(holds(inner->t == 4));
  EXPECT_TRUE(holds(inner->normal == Vec3(1, 0, 0))) << "outward from inside, too";
  EXPECT_TRUE(holds(!hit({1, 0, 1}, {1, 0, 0})));
  EXPECT_TRUE(holds(hit({1, 0, 1}, {-1, 0, 0})->t == 2));
}

// CLAIM      u runs from 0 at the seam up to 1: on the seam itself it is 0.
// ORACLE     identity: the seam is along the tangent frame's first direction.
// TOLERANCE  none.
TEST(Cylinder, BeginsAtItsSeam) {
  proves({}, Oracle::identity, "hits on the seam");
  const Cylinder cylinder{{0, 0, 0}, {0, 0, 2}, 1};
  const Vec3 seam = tangent_frame(Vec3::UnitZ()).u;
  const auto hit = intersect(Ray{Vec3(0, 0, 0.5) + 3 * seam, -seam}, cylinder);
  ASSERT_TRUE(hit.has_value());
  EXPECT_TRUE(holds(hit->uv.x() == 0));
}

}  // namespace
}  // namespace etendue::validation
