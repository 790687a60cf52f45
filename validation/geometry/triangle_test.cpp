// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/triangle.hpp"

#include <algorithm>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/plane.hpp"
#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// aimed: at a point of an edge, or at a corner, as well as double can. degenerate: exactly at an edge. nudged: 2^-45
// off.
enum class Family { general, aimed_at_edges, aimed_at_corners, degenerate, nudged };

struct Case {
  Ray ray;
  Triangle triangle;
};

Case aimed(Family family, Random& random) {
  Case c;
  const double size = random.scale(0.01, 10);
  const Vec3 middle = random.in_cube(10);
  c.triangle = {middle + random.in_cube(size), middle + random.in_cube(size), middle + random.in_cube(size)};
  c.ray.origin = random.in_cube(10);
  double p = random.uniform(-0.2, 1.2), q = random.uniform(-0.2, 1.2);
  if (family != Family::general) q = 0;
  if (family == Family::aimed_at_corners) p = static_cast<double>(random.bits() % 2);
  const Vec3 a = c.triangle.a - c.ray.origin, b = c.triangle.b - c.ray.origin, e = c.triangle.c - c.ray.origin;
  c.ray.direction = random.scale(1e-3, 1e3) * (a + p * (b - a) + q * (e - a));
  return c;
}

// Integers and sixteenths: the aim, the direction and the volumes are exact.
Case gridded(Family family, Random& random) {
  Case c;
  c.triangle = {random.dyadic(9, 0), random.dyadic(9, 0), random.dyadic(9, 0)};
  c.ray.origin = random.dyadic(20, 0);
  const double share = std::round(random.uniform(-4, 20)) / 16;
  c.ray.direction = c.triangle.a + share * (c.triangle.b - c.triangle.a) - c.ray.origin;
  if (family == Family::nudged) c.ray.direction[static_cast<Eigen::Index>(random.index(3))] += 0x1p-45;
  return c;
}

double reach(const Case& c) {
  return std::max({largest(c.triangle.a - c.ray.origin), largest(c.triangle.b - c.ray.origin),
                   largest(c.triangle.c - c.ray.origin)});
}

// CLAIM      RT.9, RT.10: hit or miss is what exact arithmetic says, for random rays, rays aimed at edges and corners,
//            rays exactly through an edge, and 2^-45 off it.
// ORACLE     exact: CGAL's Ray_3 and Triangle_3 over rationals.
// TOLERANCE  a decision may differ only where the line passes an edge within kTriangleShift · max |corner − origin|, or
//            runs in the triangle's plane (a miss by contract).
TEST(Triangle, DecidesAsExactArithmetic) {
  proves({"RT.9", "RT.10"}, Oracle::exact, "CGAL do_intersect(Ray_3, Triangle_3) over rationals");
  Random random(501);
  for (const Family family :
       {Family::general, Family::aimed_at_edges, Family::aimed_at_corners, Family::degenerate, Family::nudged}) {
    std::uint64_t mismatches = 0, on_edge = 0, doubtful = 0, hits = 0;
    constexpr std::uint64_t kCases = 4'000;
    for (std::uint64_t i = 0; i < kCases;) {
      const bool grid = family == Family::degenerate || family == Family::nudged;
      const Case c = grid ? gridded(family, random) : aimed(family, random);
      if (c.ray.direction.isZero()) continue;
      const auto signs = oracle::edge_signs(exact(c.ray.origin), exact(c.ray.direction), exact(c.triangle));
      if (signs[0] == 0 && signs[1] == 0 && signs[2] == 0) continue;  // in the plane
      ++i;
      on_edge += signs[0] == 0 || signs[1] == 0 || signs[2] == 0;
      const bool truth = oracle::ray_meets_triangle(exact(c.ray.origin), exact(c.ray.direction), exact(c.triangle));
      const bool hit = intersect(c.ray, c.triangle).has_value();
      hits += hit;
      if (hit == truth) continue;
      const double edge = oracle::distance_to_edges(exact(c.ray.origin), exact(c.ray.direction), exact(c.triangle));
      if (edge <= kTriangleShift * reach(c)) {
        ++doubtful;
      } else {
        ++mismatches;
      }
    }
    EXPECT_TRUE(all_agree(mismatches, kCases));
    EXPECT_GT(hits, kCases / 8);
    if (family == Family::degenerate) {
      EXPECT_EQ(on_edge, kCases);
    }
    if (family == Family::nudged) {
      EXPECT_LT(on_edge, kCases / 2);
    }
    if (family == Family::general) {
      EXPECT_EQ(doubtful, 0u);
    }
  }
}

// CLAIM      RT.9: along a coordinate axis nothing is rounded: the decision is exact even on edges and corners.
// ORACLE     exact: CGAL over rationals; coordinates are sixteenths, so every difference is exact.
// TOLERANCE  none.
TEST(Triangle, IsExactWhereTheShearIs) {
  proves({"RT.9"}, Oracle::exact, "CGAL do_intersect over rationals");
  Random random(502);
  std::uint64_t mismatches = 0, rays = 0, on_edge = 0;
  while (rays < 8'000) {
    Case c;
    c.triangle = {random.dyadic(1, 2), random.dyadic(1, 2), random.dyadic(1, 2)};
    c.ray.origin = random.dyadic(1, 2);
    c.ray.direction = Vec3::Zero();
    c.ray.direction[static_cast<Eigen::Index>(random.index(3))] = random.bits() % 2 ? 1 : -1;
    c.ray.origin -= 4 * c.ray.direction;
    const auto signs = oracle::edge_signs(exact(c.ray.origin), exact(c.ray.direction), exact(c.triangle));
    if (signs[0] == 0 && signs[1] == 0 && signs[2] == 0) continue;
    ++rays;
    on_edge += signs[0] == 0 || signs[1] == 0 || signs[2] == 0;
    mismatches += intersect(c.ray, c.triangle).has_value() !=
                  oracle::ray_meets_triangle(exact(c.ray.origin), exact(c.ray.direction), exact(c.triangle));
  }
  EXPECT_GT(on_edge, rays / 10);
  EXPECT_TRUE(all_agree(mismatches, rays));
}

// CLAIM      RT.9: at a hit, P0 + t d = (1 − β − γ) a + β b + γ c, and t is the exact one of the plane.
// ORACLE     exact: the plane's parameter in rationals; identity: the equation itself.
// TOLERANCE  kPlaneUlps; the hit's point_error and surface_error; for the equation the corners' shift, times the
//            condition of the shear (1/cosine to the plane).
TEST(Triangle, SolvesTheEquationOfTheLecture) {
  proves({"RT.9"}, Oracle::exact, "the plane's parameter in rationals");
  Random random(503);
  int hits = 0;
  double ulps = 0, point = 0, surface = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Case c = aimed(Family::general, random);
    const auto hit = intersect(c.ray, c.triangle);
    if (!hit) continue;
    ++hits;
    const auto truth = oracle::plane_parameter(exact(c.ray.origin), exact(c.ray.direction), exact(c.triangle));
    ASSERT_TRUE(truth);
    ulps = std::max(ulps, oracle::ulps(hit->t, *truth));
    point =
        std::max(point, oracle::distance_along(exact(hit->point), exact(c.ray.origin), exact(c.ray.direction), *truth) /
                            hit->point_error);
    const Vec3 normal = (c.triangle.b - c.triangle.a).cross(c.triangle.c - c.triangle.a);
    const double height = std::abs((hit->point - c.triangle.a).dot(hit->normal));
    surface = std::max(surface, height / hit->surface_error);
    const double beta = hit->uv.x(), gamma = hit->uv.y();
    const Vec3 right = (1 - beta - gamma) * c.triangle.a + beta * c.triangle.b + gamma * c.triangle.c;
    const double cosine = std::abs(hit->normal.dot(c.ray.direction.normalized()));
    const double edges = (c.triangle.b - c.triangle.a).norm() * (c.triangle.c - c.triangle.a).norm();
    const double condition = edges / normal.norm() / cosine;
    EXPECT_TRUE(
        within((right - hit->point).norm(), 4 * kTriangleShift * condition * (reach(c) + largest(c.ray.origin))));
  }
  EXPECT_GT(hits, 1'000);
  EXPECT_TRUE(within(ulps, kPlaneUlps));
  EXPECT_TRUE(within(point, 1));
  EXPECT_TRUE(within(surface, 1));
}

// CLAIM      RT.10, R5: inside, edge, corner, outside, parallel, in the plane, degenerate, behind; the printed rule
//            takes any real t, and so a hit at t = −1.
// ORACLE     closed form: small integers.
// TOLERANCE  none.
TEST(Triangle, NamesItsCases) {
  proves({"RT.10", "R5", "RT.2"}, Oracle::closed_form, "small integers");
  const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto hit = [&](const Vec3& origin, const Vec3& direction, const Triangle& triangle) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return intersect(ray, triangle);
  };
  const Vec3 down(0, 0, -1);
  const auto inside = hit({1, 1, 1}, down, flat);
  ASSERT_TRUE(inside);
  EXPECT_TRUE(near(inside->t, 1, 0));
  EXPECT_TRUE(holds(inside->uv == Vec2(0.25, 0.25)));
  EXPECT_TRUE(holds(inside->normal == Vec3(0, 0, 1))) << "counter-clockwise as seen from the front";
  EXPECT_TRUE(holds(hit({1, 1, -1}, -down, flat)->normal == Vec3(0, 0, 1))) << "not flipped to the ray";
  EXPECT_TRUE(holds(hit({2, 0, 1}, down, flat).has_value())) << "on an edge";
  EXPECT_TRUE(holds(hit({0, 4, 1}, down, flat).has_value())) << "on a corner";
  EXPECT_TRUE(holds(!hit({3, 3, 1}, down, flat))) << "outside";
  EXPECT_TRUE(holds(!hit({1, 1, 1}, {1, 0, 0}, flat))) << "parallel";
  EXPECT_TRUE(holds(!hit({-1, 1, 0}, {1, 0, 0}, flat))) << "in the plane";
  EXPECT_TRUE(holds(!hit({1, 0, 1}, down, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}))) << "degenerate";
  // R5: the equation has the solution t = −1 here.
  const auto printed = oracle::plane_parameter({1, 1, -1}, {0, 0, -1}, exact(flat));
  ASSERT_TRUE(printed);
  EXPECT_TRUE(holds(printed->high == -1));
  EXPECT_TRUE(holds(!hit({1, 1, -1}, down, flat))) << "behind";
}

// CLAIM      RT.10: a triangle without area is a miss from everywhere, also where the shear's rounding gives it some.
// ORACLE     closed form: corners on a line, exactly, in directions with three odd components.
// TOLERANCE  none.
TEST(Triangle, WithoutAreaIsMissed) {
  proves({"RT.10"}, Oracle::closed_form, "three corners on a line, exactly");
  Random random(205);
  std::uint64_t hits = 0;
  constexpr std::uint64_t kRays = 100'000;
  for (std::uint64_t i = 0; i < kRays; ++i) {
    const auto whole = [&] { return static_cast<double>(random.index(41)) - 20; };
    const Vec3 step(whole(), whole(), whole()), corner(whole(), whole(), whole());
    const Triangle line{corner, corner + step, corner + 2 * step};
    Ray ray;
    ray.origin = Vec3(whole(), whole(), whole());
    ray.direction = corner + random.uniform(0, 2) * step - ray.origin;
    if (ray.direction.isZero()) continue;
    hits += intersect(ray, line).has_value();
  }
  EXPECT_TRUE(all_agree(hits, kRays));
}

}  // namespace
}  // namespace etendue::validation
