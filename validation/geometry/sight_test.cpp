// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/sight.hpp"

#include <cmath>
#include <numbers>

#include "etendue/geometry/exact_decision.hpp"
#include "etendue/geometry/spawn.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Sphere random_shape(Random& random, const Sphere*) {
  const Vec3 centre = random.in_cube(2);
  return {centre, random.scale(0.01, 2)};
}
Cylinder random_shape(Random& random, const Cylinder*) {
  const Vec3 base = random.in_cube(2), along = random.unit_vector();
  const double length = random.scale(0.05, 5);
  return {base, base + length * along, random.scale(0.01, 2)};
}
// Every second one along an axis, as walls, floors and discs mostly are.
Vec3 random_normal(Random& random) {
  return random.bits() % 2 == 0 ? random.unit_vector() : Vec3(Vec3::Unit(static_cast<int>(random.index(3))));
}
Plane random_shape(Random& random, const Plane*) {
  const Vec3 point = random.in_cube(2);
  return {point, random_normal(random)};
}
Disc random_shape(Random& random, const Disc*) {
  const Vec3 centre = random.in_cube(2), normal = random_normal(random);
  return {centre, normal, random.scale(0.1, 2)};
}
Polygon random_shape(Random& random, const Polygon*) {
  const Vec3 centre = random.in_cube(2), normal = random_normal(random);
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vec3> corners;
  for (int i = 0; i < 5; ++i) {  // a star around the centre: some are concave
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.6)) / 5, out = random.uniform(0.3, 2);
    corners.push_back(centre + out * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return Polygon::make(corners).value();
}
Box random_shape(Random& random, const Box*) {
  const Vec3 centre = random.in_cube(2);
  const bool turned = random.bits() % 2 == 0;
  const Mat3 axes = turned ? random.rotation() : Mat3(Mat3::Identity());
  const double x = random.scale(0.01, 40), y = random.scale(0.01, 2);
  return {centre, axes, Vec3(x, y, random.scale(0.01, 2))};
}

struct Counts {
  std::uint64_t rays = 0, wrong = 0, unsure = 0;

  void add(const Sight& seen, const std::optional<Hit>& hit) {
    ++rays;
    unsure += seen.kind == Sight::Kind::unsure;
    wrong += seen.kind == Sight::Kind::miss && hit;
    wrong += seen.kind == Sight::Kind::hit && !(hit && hit->t <= seen.last);
    wrong += hit && hit->t < seen.first;
  }
};

template <class Shape>
void ask(const Ray& ray, const Shape& shape, Counts& counts) {
  const Sight seen = sight(ray, shape);
  counts.add(seen, intersect(ray, shape));
  if constexpr (std::is_same_v<Shape, Sphere> || std::is_same_v<Shape, Plane>) {
    const bool hits = decide_exactly(ray, shape).hit;
    counts.wrong += seen.kind == Sight::Kind::miss && hits;
    counts.wrong += seen.kind == Sight::Kind::hit && !hits;
  }
}

// What a ray meets on its way past points of the surface: aimed at hits of other rays, and beside them by 2^-1 … 2^-52.
template <class Shape>
void aim(Random& random, const Shape& shape, Counts& general, Counts& adversarial, Counts& spawned) {
  Ray ray;
  ray.origin = random.in_cube(random.scale(1, 1000));
  ray.direction = (random.in_cube(2) - ray.origin) * random.scale(0.1, 10);
  ask(ray, shape, general);
  const auto hit = intersect(ray, shape);
  if (!hit) return;
  for (const double end : {hit->t, std::nextafter(hit->t, 0), std::nextafter(hit->t, 2 * hit->t)}) {
    for (const bool from_there : {true, false}) {
      Ray part = ray;
      (from_there ? part.t_min : part.t_max) = end;
      ask(part, shape, adversarial);
      // intersect() of a box asks box_sight() itself; but what it found it must find where the ray's range holds it.
      const auto again = intersect(part, shape);
      adversarial.wrong += (again && again->t == hit->t) != (part.t_min < hit->t && hit->t < part.t_max);
    }
  }
  Ray grazing = ray;  // along the surface, nearly
  const Vec3 along = hit->normal.cross(random.unit_vector()).normalized();
  const double lift = std::ldexp(random.uniform(-1, 1), -static_cast<int>(random.index(53)));
  grazing.origin = hit->point + lift * hit->normal - random.scale(0.01, 100) * along;
  grazing.direction = along;
  ask(grazing, shape, adversarial);
  Ray leaving;
  const Vec3 away = random.unit_vector();
  const bool outward = away.dot(hit->normal) * ray.direction.dot(hit->normal) < 0;
  leaving.direction = outward ? away : Vec3(-away);  // back to the side that the ray came from
  leaving.origin = offset_origin(*hit, leaving.direction);
  const bool from_outside = ray.direction.dot(hit->normal) < 0;
  const bool one_sided = std::is_same_v<Shape, Plane> || std::is_same_v<Shape, Disc> || std::is_same_v<Shape, Polygon>;
  ask(leaving, shape, from_outside || one_sided ? spawned : adversarial);
}

template <class Shape>
void expect_no_lie(std::uint64_t seed) {
  Random random(seed);
  uses_seed(seed);
  Counts general, adversarial, spawned;
  for (int i = 0; i < 20'000; ++i) {
    aim(random, random_shape(random, static_cast<const Shape*>(nullptr)), general, adversarial, spawned);
  }
  EXPECT_TRUE(all_agree(adversarial.wrong, adversarial.rays));
  EXPECT_TRUE(all_agree(spawned.wrong, spawned.rays));
  EXPECT_GT(adversarial.unsure, 0u);  // else it knew more than doubles can
  // Rays without aim, and those that leave a surface, are what it is for.
  const std::uint64_t rarely = std::is_same_v<Shape, Polygon> ? 20 : 1000;
  EXPECT_TRUE(holds(rarely * general.unsure <= general.rays)) << general.unsure << " of " << general.rays;
  EXPECT_TRUE(holds(8 * spawned.unsure <= spawned.rays)) << spawned.unsure << " of " << spawned.rays;
}

// CLAIM      IU.5.7: what sight() says in plain doubles intersect() never contradicts: what it calls missed is missed, what it calls hit is
//            hit within its bounds, and no hit comes before its `first`. Of rays without aim one in 1000 leaves it unsure (of polygons one in
//            20), of rays that leave the surface for the side they came from one in 8.
// ORACLE     program: intersect(), whose decisions hold against exact arithmetic, and decide_exactly() of spheres and planes.
// TOLERANCE  none: decisions. Rays past any part of the surface, grazing it to 2^-52, with ranges that end at the hit, before and behind.
TEST(Sight, NeverContradictsAnIntersection) {
  proves({"IU.5.7", "IU.5.0"}, Oracle::program, "intersect() and decide_exactly()");
  expect_no_lie<Sphere>(4901);
  expect_no_lie<Cylinder>(4902);
  expect_no_lie<Plane>(4903);
  expect_no_lie<Disc>(4904);
  expect_no_lie<Polygon>(4905);
  expect_no_lie<Box>(4906);
}

}  // namespace
}  // namespace etendue::validation
