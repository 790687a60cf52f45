// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/exact_decision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

// aimed: at a point of an edge, or at a corner, as well as double can. on_edges: exactly at an edge. nudged: 2^-45 off.
// wide: every coordinate has an own exponent, 10^-150 to 10^150. denormal: multiples of the least double.
enum class Family { general, aimed_at_edges, aimed_at_corners, on_edges, nudged, wide, denormal };
constexpr Family kFamilies[] = {Family::general, Family::aimed_at_edges, Family::aimed_at_corners, Family::on_edges,
                                Family::nudged,  Family::wide,           Family::denormal};

constexpr double kLeast = std::numeric_limits<double>::denorm_min();

Vec3 wide(Random& random) {
  Vec3 v;
  for (double& x : v) {
    x = random.scale(1e-150, 1e150);
    if (random.bits() % 2 == 0) x = -x;
  }
  return v;
}

struct Case {
  Ray ray;
  Triangle triangle;
};

Case of(Family family, Random& random) {
  Case c;
  const auto corner = [&]() -> Vec3 {
    if (family == Family::wide) return wide(random);
    if (family == Family::denormal) return random.dyadic(9, 0) * kLeast;
    if (family == Family::on_edges || family == Family::nudged) return random.dyadic(9, 0);
    return random.in_cube(1);
  };
  c.triangle.a = corner();
  c.triangle.b = corner();
  c.triangle.c = corner();
  const Triangle& t = c.triangle;
  if (family == Family::on_edges || family == Family::nudged || family == Family::denormal) {
    // Whole numbers: the aim is exact. Every second denormal ray goes through a corner.
    const double step = family == Family::denormal ? kLeast : 1;
    c.ray.origin = random.dyadic(20, 0) * step;
    const double share =
        family == Family::denormal ? static_cast<double>(random.bits() % 2) : std::round(random.uniform(-4, 20)) / 16;
    c.ray.direction = t.a + share * (t.b - t.a) - c.ray.origin;
    if (family == Family::nudged) c.ray.direction[static_cast<Eigen::Index>(random.index(3))] += 0x1p-45;
    if (family == Family::denormal && random.bits() % 2 == 0) c.ray.direction += random.dyadic(3, 0) * kLeast;
    return c;
  }
  c.ray.origin = family == Family::wide ? wide(random) : random.in_cube(10);
  double p = random.uniform(-0.2, 1.2), q = random.uniform(-0.2, 1.2);
  if (family == Family::aimed_at_edges || family == Family::aimed_at_corners) q = 0;
  if (family == Family::aimed_at_corners) p = static_cast<double>(random.bits() % 2);
  c.ray.direction = (t.a - c.ray.origin) + p * (t.b - t.a) + q * (t.c - t.a);
  return c;
}

// CLAIM      RT.9, RT.10, IU.5.0: the exact decision is that of rational numbers, for aimed rays, rays exactly through edges,
//            2^-45 beside them, coordinates from 1e-150 to 1e150 and denormal ones; doubles alone decide where nothing is near.
// ORACLE     exact: CGAL's Ray_3 and Triangle_3 over rationals.
// TOLERANCE  none.
TEST(ExactDecision, OfATriangleIsThatOfRationalNumbers) {
  proves({"RT.9", "RT.10", "IU.5.0"}, Oracle::exact,
         "CGAL do_intersect(Ray_3, Triangle_3) over rationals, 70,000 rays");
  constexpr std::uint64_t kSeed = 20261122;
  uses_seed(kSeed);
  Random random(kSeed);
  for (const Family family : kFamilies) {
    const std::uint64_t cases = long_run(10'000);
    std::uint64_t mismatches = 0, hits = 0, by_integers = 0;
    for (std::uint64_t i = 0; i < cases;) {
      share_done(i, cases);
      const Case c = of(family, random);
      const oracle::Point origin = exact(c.ray.origin), direction = exact(c.ray.direction);
      if (c.ray.direction.isZero(0)) continue;
      // CGAL counts rays that begin in the plane.
      if (oracle::volume_sign(origin, exact(c.triangle)) == 0) continue;
      ++i;
      const Decision decision = decide_exactly(c.ray, c.triangle);
      mismatches += decision.hit != oracle::ray_meets_triangle(origin, direction, exact(c.triangle));
      hits += decision.hit;
      by_integers += decision.tier == Tier::integers;
    }
    EXPECT_TRUE(all_agree(mismatches, cases));
    EXPECT_GT(hits, cases / 20) << static_cast<int>(family);
    if (family == Family::general) {
      EXPECT_LT(by_integers, cases / 1000);
    }
    if (family == Family::on_edges || family == Family::nudged) {
      EXPECT_GT(by_integers, cases / 4);
    }
  }
}

bool is_less(double t, const oracle::Wide& root) {
  return t < root.high || (t == root.high && root.low > 0);
}
bool is_less(const oracle::Wide& root, double t) {
  return root.high < t || (root.high == t && root.low < 0);
}

// As the lecture says it: a root of the quadratic within the range, none where the line is a tangent.
bool truth(const Ray& ray, const Sphere& sphere) {
  const auto roots = oracle::sphere_roots(exact(ray.origin), exact(ray.direction), exact(sphere.centre), sphere.radius);
  if (roots.discriminant <= 0) return false;
  const auto counts = [&](const oracle::Wide& root) {
    return is_less(std::max(0.0, ray.t_min), root) && is_less(root, ray.t_max);
  };
  return counts(roots.near) || counts(roots.far);
}

// CLAIM      IU.5-9, IU.5-10, RT.8: the exact decision about a sphere is that of rational numbers, for tangents, lines beside
//            them by 2^-45, origins on the sphere, ranges that end on it, exponents far apart and denormal numbers.
// ORACLE     exact: roots of the quadratic, signs rational, at 1000 bits.
// TOLERANCE  none.
TEST(ExactDecision, OfASphereIsThatOfRationalNumbers) {
  proves({"IU.5-9", "IU.5-10", "RT.8"}, Oracle::exact, "roots over rationals, 200,000 rays");
  constexpr std::uint64_t kSeed = 20261123;
  uses_seed(kSeed);
  Random random(kSeed);
  const std::uint64_t cases = long_run(200'000);
  std::uint64_t mismatches = 0, hits = 0, tangents = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    share_done(i, cases);
    Ray ray;
    Sphere sphere{Vec3::Zero(), 1};
    const std::uint64_t family = i % 5;
    if (family == 0) {
      sphere = {random.in_cube(5), random.scale(1e-3, 10)};
      ray.origin = random.in_cube(10);
      ray.direction = sphere.centre + random.in_cube(2 * sphere.radius) - ray.origin;
    } else if (family == 1) {
      // 3² + 4² = 5²: the line x = 3, y = 4, z = t touches a sphere of radius 5 around the origin of the lattice.
      const Vec3 shift = random.dyadic(1000, 0);
      sphere = {shift, 5};
      ray.origin = shift + Vec3(3, 4, -std::round(random.uniform(-10, 20)));
      ray.direction = Vec3(0, 0, std::ldexp(1.0, static_cast<int>(random.index(9))));
      if (random.bits() % 2 == 0) ray.direction.x() = std::ldexp(random.uniform(-1, 1), -45);
    } else if (family == 2) {
      // Origins on the sphere, and ranges that end where the line leaves or enters it.
      const Vec3 shift = random.dyadic(1000, 0);
      sphere = {shift, 5};
      ray.origin = shift + Vec3(random.bits() % 2 == 0 ? 3 : -3, random.bits() % 2 == 0 ? 4 : -9, 0);
      ray.direction = random.bits() % 3 == 0 ? random.dyadic(5, 0) : Vec3(random.bits() % 2 == 0 ? 1 : -1, 0, 0);
      if (random.bits() % 2 == 0) ray.t_max = std::round(random.uniform(1, 9));
      if (random.bits() % 2 == 0) ray.t_min = std::round(random.uniform(-2, 7));
    } else if (family == 3) {
      sphere = {wide(random), random.scale(1e-150, 1e150)};
      ray.origin = wide(random);
      ray.direction = sphere.centre - ray.origin;
      ray.direction[static_cast<Eigen::Index>(random.index(3))] += random.uniform(-2, 2) * sphere.radius;
    } else {
      sphere = {random.dyadic(9, 0) * kLeast, std::round(random.uniform(1, 9)) * kLeast};
      ray.origin = random.dyadic(20, 0) * kLeast;
      ray.direction = random.dyadic(9, 0) * kLeast;
    }
    if (ray.direction.isZero(0)) ray.direction.z() = 1;
    const Decision decision = decide_exactly(ray, sphere);
    tangents += family == 1 && ray.direction.x() == 0 && !decision.hit && decision.tier == Tier::integers;
    mismatches += decision.hit != truth(ray, sphere);
    hits += decision.hit;
  }
  EXPECT_TRUE(all_agree(mismatches, cases));
  EXPECT_GT(hits, cases / 5);
  EXPECT_GT(tangents, cases / 50);
}

// CLAIM      IU.5-12, RT.12: the exact decision about a plane is that of rational numbers, parallel rays and origins on the
//            plane among them.
// ORACLE     exact: the parameter over rationals.
// TOLERANCE  none.
TEST(ExactDecision, OfAPlaneIsThatOfRationalNumbers) {
  proves({"IU.5-12", "RT.12"}, Oracle::exact, "parameter over rationals, 40,000 rays");
  constexpr std::uint64_t kSeed = 20261124;
  uses_seed(kSeed);
  Random random(kSeed);
  const std::uint64_t cases = long_run(40'000);
  std::uint64_t mismatches = 0, hits = 0, parallel = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    share_done(i, cases);
    Ray ray;
    Plane plane;
    if (i % 2 == 0) {
      plane = {wide(random), random.unit_vector()};
      ray.origin = wide(random);
      ray.direction = wide(random);
    } else {
      // Whole numbers; the ray's direction is parallel to the plane in one of a few cases, its origin on it in others.
      plane = {random.dyadic(9, 0), random.dyadic(3, 0)};
      ray.origin = random.dyadic(9, 0);
      ray.direction = random.dyadic(3, 0);
      if (plane.normal.isZero(0)) plane.normal.x() = 1;
      if (ray.direction.isZero(0)) ray.direction.x() = 1;
    }
    const auto t =
        oracle::plane_parameter(exact(ray.origin), exact(ray.direction), exact(plane.point), exact(plane.normal));
    const bool met = t && (t->high > 0 || (t->high == 0 && t->low > 0));
    const Decision decision = decide_exactly(ray, plane);
    mismatches += decision.hit != met;
    hits += decision.hit;
    parallel += !t;
  }
  EXPECT_TRUE(all_agree(mismatches, cases));
  EXPECT_GT(hits, cases / 5);
  EXPECT_GT(parallel, cases / 100);
}

// CLAIM      IU.5.6.2, E16: of two polygons that a chain of edges divides, a line exactly through the chain passes one, and
//            elsewhere the exact decision is that of rational numbers in the polygon's plane, in leaning planes too.
// ORACLE     exact: CGAL's bounded_side_2 over rationals; on the chain, that the two make up the whole.
// TOLERANCE  none.
TEST(ExactDecision, OfAPolygonIsThatOfRationalNumbers) {
  proves({"IU.5.6.2"}, Oracle::exact, "bounded_side_2 over rationals, 50,000 rays");
  constexpr std::uint64_t kSeed = 20261125;
  uses_seed(kSeed);
  Random random(kSeed);
  const std::uint64_t cases = long_run(50'000);
  constexpr std::uint64_t kRaysEach = 100;
  std::uint64_t mismatches = 0, on_the_chain = 0, hits = 0;
  for (std::uint64_t i = 0; i < cases / kRaysEach; ++i) {
    share_done(i * kRaysEach, cases);
    // A square of 16, cut by a chain from its left to its right side; x and y are whole, z leans by whole slopes.
    std::vector<oracle::Flat> lower{{0, 0}, {16, 0}}, upper{{16, 16}, {0, 16}}, chain;
    for (int x = 16; x >= 0; x -= 4) chain.push_back({static_cast<double>(x), std::round(random.uniform(1, 15))});
    lower.insert(lower.end(), chain.begin(), chain.end());
    upper.insert(upper.end(), chain.rbegin(), chain.rend());
    const Vec2 slope(std::round(random.uniform(-3, 3)), std::round(random.uniform(-3, 3)));
    const auto lifted = [&](double x, double y) { return Vec3(x, y, slope.x() * x + slope.y() * y); };
    const auto made = [&](const std::vector<oracle::Flat>& flat) {
      std::vector<Vec3> vertices;
      for (const auto& p : flat) vertices.push_back(lifted(p[0], p[1]));
      return Polygon::make(vertices).value();
    };
    const Polygon below = made(lower), above = made(upper);
    for (std::uint64_t k = 0; k < kRaysEach; ++k) {
      const bool aimed = k % 2 == 0;
      oracle::Flat at{std::round(random.uniform(-2, 18)), std::round(random.uniform(-2, 18))};
      if (aimed) {
        const std::size_t edge = random.index(chain.size() - 1);
        const double share = static_cast<double>(random.index(5)) / 4;
        for (std::size_t c = 0; c < 2; ++c) at[c] = chain[edge][c] + share * (chain[edge + 1][c] - chain[edge][c]);
      }
      Ray ray;
      ray.direction = random.dyadic(9, 0);
      ray.direction.z() += slope.dot(ray.direction.head<2>()) + 10;
      ray.origin = lifted(at[0], at[1]) - 2 * ray.direction;
      const bool low = decide_exactly(ray, below).hit, high = decide_exactly(ray, above).hit;
      if (oracle::side_of_polygon(at, lower) == 0 || oracle::side_of_polygon(at, upper) == 0) {
        const bool inside = at[0] > 0 && at[0] < 16 && at[1] > 0 && at[1] < 16;
        if (inside) ++on_the_chain;
        mismatches += inside && low == high;
        continue;
      }
      mismatches += low != (oracle::side_of_polygon(at, lower) > 0) || high != (oracle::side_of_polygon(at, upper) > 0);
      hits += low || high;
    }
  }
  EXPECT_TRUE(all_agree(mismatches, cases));
  EXPECT_GT(on_the_chain, cases / 4);
  EXPECT_GT(hits, cases / 5);
}

// CLAIM      IU.5.0: what is not finite, a direction of length zero and a radius that is not positive are refused; a range
//            that is empty is a miss.
// ORACLE     identity: the contract.
// TOLERANCE  none.
TEST(ExactDecision, RefusesWhatItCannotDecide) {
  proves({"IU.5.0"}, Oracle::identity, "the contract");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  Ray ray;
  ray.origin = {0.25, 0.25, -1};
  const Triangle triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(holds(decide_exactly(ray, triangle).hit));
  EXPECT_TRUE(refuses([&] { return decide_exactly(ray, Triangle{{kNan, 0, 0}, {1, 0, 0}, {0, 1, 0}}); }));
  EXPECT_TRUE(refuses([&] { return decide_exactly(ray, Sphere{{0, 0, 0}, 0}); }));
  EXPECT_TRUE(refuses([&] { return decide_exactly(ray, Sphere{{0, 0, 0}, kInfinity}); }));
  EXPECT_TRUE(refuses([&] { return decide_exactly(ray, Plane{{0, 0, 0}, {0, kNan, 1}}); }));
  Ray still = ray;
  still.direction = Vec3::Zero();
  EXPECT_TRUE(refuses([&] { return decide_exactly(still, triangle); }));
  ray.t_min = kInfinity;
  EXPECT_TRUE(holds(!decide_exactly(ray, triangle).hit));
  ray.t_min = 1;
  EXPECT_TRUE(holds(!decide_exactly(ray, triangle).hit));
}

}  // namespace
}  // namespace etendue::validation
