// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/spawn.hpp"

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/box.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/plane.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/triangle.hpp"
#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// Where a shape is built: a random frame, a size, a place.
struct Place {
  Mat3 frame;
  double size;
  Vec3 offset;
  Vec3 operator()(double x, double y, double z) const { return frame * (size * Vec3(x, y, z)) + offset; }
};

Place random_place(Random& random, int i) {
  Place place;
  place.frame = random.rotation();
  place.size = random.scale(1e-6, 1e6);
  // Around the origin; at 10⁶ units; at 10⁶ times the shape's size.
  place.offset = random.in_cube(i % 3 == 0 ? 0 : i % 3 == 1 ? 1e6 : 1e6 * place.size);
  return place;
}

// What a shape may lose of its size to the rounding of its own coordinates; such places cannot hold it.
bool drowns(const Place& place) {
  return largest(place.offset) * kUnitRoundoff > 1e-6 * place.size;
}

struct Tally {
  std::uint64_t self_hits = 0, secondary = 0;
};

// Half of the directions are within 10⁻⁶ … 10⁻¹⁶ of the tangent plane.
Vec3 leaving(const Vec3& outside, Random& random) {
  Vec3 direction = random.unit_vector();
  if (random.bits() % 2) direction = direction.cross(outside).normalized() + random.scale(1e-16, 1e-6) * outside;
  return direction.dot(outside) < 0 ? Vec3(-direction) : direction;
}

// Rays that leave a shape from the side where it cannot meet itself again.
template <class Shape>
void spawn_from(const Shape& shape, const Ray& ray, bool flat, Random& random, Tally& tally) {
  const auto hit = intersect(ray, shape);
  if (!hit) return;
  for (int k = 0; k < 8; ++k) {
    const Vec3 outside = flat && random.bits() % 2 ? Vec3(-hit->normal) : hit->normal;
    Ray next;
    next.direction = leaving(outside, random) * random.scale(1e-3, 1e3);
    // Grazing directions may lead to the other side by rounding; that is decided exactly.
    if (oracle::side_of_plane(exact(next.direction), {0, 0, 0}, exact(outside)) <= 0) continue;
    next.origin = offset_origin(*hit, next.direction);
    ++tally.secondary;
    tally.self_hits += intersect(next, shape).has_value();
  }
}

template <class Make>
Tally spawned(std::uint64_t seed, bool flat, Make make) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < 3'000; ++i) {
    const Place place = random_place(random, i);
    if (drowns(place)) continue;
    Ray ray;
    ray.origin = place(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(1.5, 9));
    ray.direction = place(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0) - ray.origin;
    spawn_from(make(place), ray, flat, random, tally);
  }
  EXPECT_GT(tally.secondary, 5'000u);
  return tally;
}

// CLAIM      IU.5.4b, G8: a ray that leaves a surface from offset_origin() does not meet it again: every shape, random
//            frames, sizes 10⁻⁶ … 10⁶, offsets up to 10⁶, directions down to 10⁻¹⁶ over the tangent plane.
// ORACLE     identity: a plane, or a convex body from outside, is not met again by a ray that leaves it.
// TOLERANCE  none: 0 self-hits.
TEST(Spawn, NoShapeShadowsItself) {
  proves({"IU.5.4b", "G8"}, Oracle::identity, "a ray that leaves a convex surface does not meet it again");
  const auto check = [](const char* shape, const Tally& tally) {
    EXPECT_TRUE(all_agree(tally.self_hits, tally.secondary)) << shape;
  };
  check("sphere", spawned(901, false, [](const Place& p) { return Sphere{p(0, 0, 0), p.size}; }));
  check("plane", spawned(902, true, [](const Place& p) { return Plane{p(0.3, 0.2, 0), p.frame.col(2)}; }));
  check("disc", spawned(903, true, [](const Place& p) { return Disc{p(0, 0, 0), p.frame.col(2), p.size}; }));
  check("triangle", spawned(904, true, [](const Place& p) { return Triangle{p(-1, -1, 0), p(1, -1, 0), p(0, 2, 0)}; }));
  check("polygon", spawned(905, true, [](const Place& p) {
          return *Polygon::make({p(-1, -1, 0), p(1, -1, 0), p(1, 1, 0), p(0, 0.7, 0), p(-1, 1, 0)});
        }));
  check("cylinder", spawned(906, false, [](const Place& p) { return Cylinder{p(-1, 0, 0), p(1, 0.2, 0), p.size}; }));
  check("box", spawned(907, false, [](const Place& p) { return Box{p(0, 0, 0), p.frame, p.size * Vec3(1, 2, 0.5)}; }));
}

// CLAIM      IU.5.4b, G8: what lies well above the bound is not lost: a parallel plane 100 spawn distances away is hit.
// ORACLE     closed form: distance over cosine.
// TOLERANCE  none for the decision; of the distance, twice the spawn distance over the cosine.
TEST(Spawn, NearbySurfacesAreNotLost) {
  proves({"IU.5.4b", "G8"}, Oracle::closed_form, "distance between parallel planes");
  Random random(908);
  std::uint64_t lost = 0, rays = 0;
  for (int i = 0; i < 3'000; ++i) {
    const Place place = random_place(random, i);
    if (drowns(place)) continue;
    const Plane plane{place(0, 0, 0), place.frame.col(2)};
    Ray ray;
    ray.origin = place(1, 2, 3);
    ray.direction = place(0.1, 0.2, 0) - ray.origin;
    const auto hit = intersect(ray, plane);
    ASSERT_TRUE(hit);
    Ray next;
    next.direction = (plane.normal + 0.5 * random.in_cube(1)).normalized();
    next.origin = offset_origin(*hit, next.direction);
    const double spawn = (next.origin - hit->point).norm(), gap = 100 * spawn + 1e-9 * place.size;
    const auto above = intersect(next, Plane{hit->point + gap * plane.normal, plane.normal});
    ++rays;
    lost += !above;
    const double cosine = next.direction.dot(plane.normal);
    if (!above) continue;
    EXPECT_TRUE(within(std::abs(above->t - gap / cosine), 2 * spawn / cosine));
  }
  EXPECT_TRUE(all_agree(lost, rays));
}

// CLAIM      G8: a fixed ε = 10⁻⁵ is less than one ulp at coordinates of 10⁶ in single precision, of 10¹² in double: it
//            moves nothing; offset_origin() still leaves the sphere.
// ORACLE     closed form: ulp(10¹²) = 1.2·10⁻⁴ > 10⁻⁵.
// TOLERANCE  none.
TEST(Spawn, FixedEpsilonIsBelowOneUlpFarAway) {
  proves({"G8"}, Oracle::closed_form, "spacing of doubles");
  const Vec3 centre(1e12, 1e12, 1e12);
  const double printed = 1e-5;
  EXPECT_TRUE(near(centre.x() + printed, centre.x(), 0)) << "the printed cure does not move the origin";
  const Sphere sphere{centre, 1e3};
  Ray ray;
  ray.origin = centre + Vec3(0, 0, 5e3);
  ray.direction = Vec3(0.01, 0.02, -1);
  const auto hit = intersect(ray, sphere);
  ASSERT_TRUE(hit);
  Ray next;
  next.direction = hit->normal;
  next.origin = offset_origin(*hit, next.direction);
  EXPECT_TRUE(holds(!intersect(next, sphere)));
}

}  // namespace
}  // namespace etendue::validation
