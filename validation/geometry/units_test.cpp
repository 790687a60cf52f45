// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <optional>

#include "etendue/geometry/bezier.hpp"
#include "etendue/geometry/box.hpp"
#include "etendue/geometry/cone.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/quadric.hpp"
#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/torus.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Sphere scaled(const Sphere& s, double by) {
  return {by * s.centre, by * s.radius};
}
Disc scaled(const Disc& s, double by) {
  return {by * s.centre, s.normal, by * s.radius};
}
Cylinder scaled(const Cylinder& s, double by) {
  return {by * s.base, by * s.top, by * s.radius};
}
Cone scaled(const Cone& s, double by) {
  return {by * s.base, by * s.top, by * s.base_radius, by * s.top_radius};
}
Torus scaled(const Torus& s, double by) {
  return {by * s.centre, s.axis, by * s.ring, by * s.tube};
}
Box scaled(const Box& s, double by) {
  return {by * s.centre, s.axes, by * s.half_edges};
}
Quadric scaled(const Quadric& s, double by) {
  return {s.square, by * s.linear, by * by * s.constant, scaled(s.box, by)};
}
BezierSurface scaled(BezierSurface s, double by) {
  for (auto& row : s.control) {
    for (Vec3& p : row) p *= by;
  }
  return s;
}

bool same(const std::optional<Hit>& a, const std::optional<Hit>& b, double length, double time) {
  if (!a || !b) return !a && !b;
  return b->t == time * a->t && b->point == length * a->point && b->normal == a->normal && b->uv == a->uv &&
         b->point_error == length * a->point_error && b->surface_error == length * a->surface_error;
}

struct Counts {
  std::uint64_t rays = 0, hits = 0, other = 0;
};

/// Rays from all around at places near the shape, met in three units of length and for three lengths of their directions.
template <class Shape>
Counts met_in_all_units(Random& random, const Shape& shape) {
  Counts counts;
  for (int i = 0; i < 300; ++i) {
    Ray ray;
    ray.origin = random.in_cube(4);
    ray.direction = random.in_cube(0.7) - ray.origin;
    const auto hit = intersect(ray, shape);
    ++counts.rays;
    counts.hits += hit.has_value();
    for (const double by : {0x1p-40, 0x1p40}) {
      Ray longer = ray, larger = ray;
      longer.direction *= by;
      larger.origin *= by, larger.direction *= by;
      const bool differs =
          !same(hit, intersect(longer, shape), 1, 1 / by) || !same(hit, intersect(larger, scaled(shape, by)), by, 1);
      counts.other += differs;
    }
  }
  return counts;
}

// CLAIM      IU.5.0: no intersection knows a unit of length, nor how long a direction is: with either times a power of two the hit is the
//            same to the last bit, with its errors.
// ORACLE     metamorphic: lengths and directions times 2^±40.
// TOLERANCE  none: such products are exact.
TEST(Intersections, KnowNoUnit) {
  proves({"IU.5.0"}, Oracle::metamorphic, "eight shapes, lengths and directions times 2^±40");
  constexpr std::uint64_t kSeed = 20261202;
  uses_seed(kSeed);
  Random random(kSeed);
  const auto check = [&](const auto& shape, const char* name) {
    const Counts counts = met_in_all_units(random, shape);
    EXPECT_GT(counts.hits, 30u) << name;
    EXPECT_TRUE(all_agree(counts.other, 2 * counts.rays)) << name;
  };
  const Vec3 axis = Vec3(0.3, -0.4, 1.1);
  check(Sphere{{0.1, 0.2, -0.1}, 0.8}, "sphere");
  check(Disc{{0.1, 0.2, -0.1}, axis.normalized(), 0.9}, "disc");
  check(Cylinder{-0.7 * axis, 0.6 * axis, 0.5}, "cylinder");
  check(Cone{-0.7 * axis, 0.6 * axis, 0.7, 0.2}, "cone");
  check(Torus{{0.1, 0, 0}, axis, 0.7, 0.3}, "torus");
  check(Box{{0.1, 0.2, 0}, random.rotation(), {0.5, 0.4, 0.7}}, "box");
  Quadric saddle;
  saddle.square = Vec3(1.1, -0.7, 0.3).asDiagonal();
  saddle.linear = {0.1, 0.2, -0.4};
  saddle.constant = -0.1;
  saddle.box = {Vec3::Zero(), random.rotation(), {0.9, 0.8, 0.7}};
  check(saddle, "quadric");
  BezierSurface surface;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      surface.control[i][j] =
          Vec3(0.5 * static_cast<double>(i) - 0.75, 0.5 * static_cast<double>(j) - 0.75, random.uniform(-0.4, 0.4));
    }
  }
  check(surface, "Bézier surface");
}

}  // namespace
}  // namespace etendue::validation
