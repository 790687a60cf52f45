// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/cone.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "oracles/line_roots.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// Height of the line's point at t over the base, in units of the axis; in double.
double height_at(const Ray& ray, const Cone& cone, double t) {
  const Vec3 axis = cone.top - cone.base;
  return (ray.origin - cone.base + t * ray.direction).dot(axis) / axis.squaredNorm();
}

Cone random_cone(Random& random, int i) {
  Cone cone;
  cone.base = random.in_cube(100);
  cone.top = cone.base + random.unit_vector() * random.scale(0.1, 10);
  cone.base_radius = i % 4 == 1 ? 0 : random.scale(0.01, 3);
  cone.top_radius = i % 4 == 0 ? 0 : random.scale(0.01, 3);
  if (i % 7 == 3) {  // slender, up to the domain's end
    const double radius = std::max(cone.base_radius, cone.top_radius);
    cone.top = cone.base + random.unit_vector() * radius * random.scale(1, 0.99 * kSlenderestCone);
  }
  return cone;
}

// A third grazes the wall, 2^-1 … 2^-30 radii inside or outside; a fifth begins inside or near it.
Ray aimed_ray(Random& random, const Cone& cone, int i) {
  const Vec3 axis = cone.top - cone.base, side = axis.cross(random.unit_vector()).normalized();
  const double height = random.uniform(0, 1), widening = cone.top_radius - cone.base_radius;
  const double radius = cone.base_radius + widening * height;
  const bool grazes = i % 3 == 0;
  const double halvings = 1 + static_cast<double>(random.index(30));
  const double aside = grazes ? 1 + random.uniform(-1, 1) * std::exp2(-halvings) : random.uniform(0, 1.2);
  const Vec3 target = cone.base + height * axis + aside * radius * side, any = random.unit_vector();
  const Vec3 outward = side - widening / axis.norm() * axis.normalized();
  const Vec3 along = grazes ? outward.cross(any).normalized() : any;
  Ray ray;
  ray.origin = target - along * random.scale(0.1, 1e4) * radius;
  if (i % 5 == 0) ray.origin = cone.base + height * axis + 0.5 * radius * random.unit_vector();
  ray.direction = (target - ray.origin) * random.scale(0.1, 10);
  return ray;
}

// CLAIM      IU.5.0: a cone, whole or truncated, narrowing or widening, is hit where and when the exact quadratic says,
//            from outside and inside, also by grazing rays; the mirrored nappe is not there.
// ORACLE     exact: the quadratic with rational coefficients, roots isolated by Arb.
// TOLERANCE  kConeUlps for t; the hit's own point_error; decisions are open where a root's height, computed in double
//            to some 2^-50 of the way in units of the axis, is within 64 times that of an end, and nowhere else.
TEST(Cone, IsHitAsTheExactQuadraticSays) {
  proves({"IU.5.0"}, Oracle::exact, "rational quadratic, isolated roots");
  uses_seed(821);
  Random random(821);
  std::uint64_t mismatches = 0, rays = 0, hits = 0, open = 0;
  double ulps = 0, point = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Cone cone = random_cone(random, i);
    const Ray ray = aimed_ray(random, cone, i);
    const double axis = (cone.top - cone.base).norm();
    const auto roots = oracle::cone_roots(exact(ray.origin), exact(ray.direction), exact(cone.base), exact(cone.top),
                                          cone.base_radius, cone.top_radius);
    std::optional<oracle::Wide> truth;
    bool undecided = false;
    for (const oracle::Wide& t : roots.changes) {
      const double height = height_at(ray, cone, t.high);
      const double rounding = 0x1p-44 * (1 + (std::abs(t.high) * ray.direction.norm() + largest(ray.origin)) / axis);
      undecided = undecided || std::min(std::abs(height), std::abs(height - 1)) < rounding;
      if (!truth && t.high > 0 && height >= 0 && height <= 1) truth = t;
    }
    open += undecided;
    if (undecided) continue;
    const auto hit = intersect(ray, cone);
    ++rays;
    mismatches += hit.has_value() != truth.has_value();
    if (!hit || !truth) continue;
    ++hits;
    ulps = std::max(ulps, oracle::ulps(hit->t, *truth));
    point = std::max(point, oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), *truth) /
                                hit->point_error);
  }
  EXPECT_GT(hits, rays / 4);
  EXPECT_LT(open, rays / 1000 + 1);
  EXPECT_TRUE(all_agree(mismatches, rays));
  EXPECT_TRUE(within(ulps, kConeUlps));
  EXPECT_TRUE(within(point, 1));
}

// CLAIM      IU.5.0: the ends are open, the apex is there, a tangent is a miss, an origin on the wall is not hit at 0,
//            normals are at right angles to the wall and point outward also from inside.
// ORACLE     closed form: the cone of height 1 and radius 1 around z, apex at the top.
// TOLERANCE  normals: three roundings of numbers up to 1 and a normalisation, below 2^-50.
TEST(Cone, IsOnlyItsWall) {
  proves({"IU.5.0"}, Oracle::closed_form, "the cone z + |(x, y)| = 1");
  const Cone cone{{0, 0, 0}, {0, 0, 1}, 1, 0};
  const auto hit = [&](const Vec3& origin, const Vec3& direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return intersect(ray, cone);
  };
  const double slant = std::sqrt(0.5);
  const auto side = hit({2, 0, 0.5}, {-1, 0, 0});
  ASSERT_TRUE(side);
  EXPECT_TRUE(holds(side->t == 1.5 && side->uv == Vec2(0, 0.5)));
  EXPECT_TRUE(within((side->normal - Vec3(slant, 0, slant)).norm(), 0x1p-50));
  const auto inside = hit({0, 0, 0.5}, {0, 2, 0});
  ASSERT_TRUE(inside);
  EXPECT_TRUE(holds(inside->t == 0.25));
  EXPECT_TRUE(within((inside->normal - Vec3(0, slant, slant)).norm(), 0x1p-50));
  const auto apex = hit({0, 0, 3}, {0, 0, -1});
  ASSERT_TRUE(apex) << "straight onto the apex";
  EXPECT_TRUE(holds(apex->t == 2 && apex->normal == Vec3(0, 0, 1) && apex->uv.y() == 1));
  EXPECT_TRUE(holds(hit({-1, 0, 1}, {1, 0, 0})->t == 1)) << "past the apex, touching it";
  EXPECT_TRUE(holds(!hit({-1, 0, 1.25}, {1, 0, 0}))) << "over the apex: the other nappe is not there";
  EXPECT_TRUE(holds(!hit({0.25, 0, -0.5}, {1, 0, 0}))) << "below the base";
  EXPECT_TRUE(holds(hit({0.25, 0, -0.5}, {0, 0, 1})->t == 1.25)) << "in through the open base";
  EXPECT_TRUE(holds(!hit({-3, 0.5, 0.5}, {1, 0, 0}))) << "tangent to the circle at half height";
  EXPECT_TRUE(holds(!hit({1, 0, 0}, {1, 0, 0}))) << "from the wall outward";
  // Turned round, heights count from the other end.
  const Cone turned{{0, 0, 1}, {0, 0, 0}, 0, 1};
  Ray ray;
  ray.origin = {2, 0, 0.25};
  ray.direction = {-1, 0, 0};
  EXPECT_TRUE(holds(intersect(ray, turned)->t == 1.25 && intersect(ray, turned)->uv.y() == 0.75));
  // Equal radii make a cylinder.
  EXPECT_TRUE(holds(intersect(ray, Cone{{0, 0, 0}, {0, 0, 1}, 1, 1})->normal == Vec3(1, 0, 0)));
}

// CLAIM      a cone without radii, height or finite numbers is refused.
// ORACLE     closed form: the domain.
// TOLERANCE  none.
TEST(Cone, RefusesWhatIsNone) {
  proves({}, Oracle::closed_form, "the domain as documented");
  const Ray ray;
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Cone{Vec3::Zero(), Vec3::UnitZ(), 0, 0}); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Cone{Vec3::Zero(), Vec3::UnitZ(), -1, 2}); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Cone{Vec3::Zero(), Vec3::Zero(), 1, 2}); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Cone{Vec3::Zero(), Vec3(0, 0, NAN), 1, 2}); }));
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, Cone{Vec3::Zero(), Vec3::UnitZ(), INFINITY, 2}); }));
}

// CLAIM      a hit's point lies off the cone by at most its surface_error, which is some roundings of the coordinates.
// ORACLE     program: the distance from the cone's equation, in long double.
// TOLERANCE  the hit's own surface_error; at most 1e-13 for coordinates below 8.
TEST(Cone, LiesWithinItsSurfaceError) {
  proves({}, Oracle::program, "distance from the cone in long double");
  using Wide = Eigen::Matrix<long double, 3, 1>;
  const Cone cone{{0.3, -0.2, 0.1}, {1.1, 0.7, 2.3}, 1.25, 0.5};
  const Wide base = cone.base.cast<long double>(), way = cone.top.cast<long double>() - base, axis = way.normalized();
  const long double slope = (0.5L - 1.25L) / way.norm();
  CounterRandom random(20261126);
  uses_seed(20261126);
  double worst = 0, largest = 0;
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&] { return random.between(-4, 4); };
    const Vec3 from(number(), number(), number()), to(0.5 * number(), 0.5 * number(), number());
    const auto hit = intersect(Ray{from, to - from}, cone);
    if (!hit) continue;
    ++hits;
    const Wide p = hit->point.cast<long double>() - base;
    const long double height = p.dot(axis),
                      off = ((p - height * axis).norm() - 1.25L - slope * height) / std::sqrt(1 + slope * slope);
    worst = std::max(worst, static_cast<double>(std::abs(off)) / hit->surface_error);
    largest = std::max(largest, hit->surface_error);
  }
  EXPECT_TRUE(holds(hits > 200));
  EXPECT_TRUE(within(worst, 1));
  EXPECT_TRUE(within(largest, 1e-13));
}

}  // namespace
}  // namespace etendue::validation
