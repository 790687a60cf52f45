// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/aabb.hpp"

#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

bool contains(const Aabb& box, const Vec3& p, double shift) {
  return (box.low.array() <= p.array() + shift).all() && (p.array() - shift <= box.high.array()).all();
}

// How far over its edges a ray from this distance may hit the shape, by contract.
template <class Shape>
double shift(const Shape&, double) {
  return 0;
}
double shift(const Triangle&, double distance) {
  return kTriangleShift * distance;
}
double shift(const Polygon&, double distance) {
  return kTriangleShift * distance;
}
double shift(const Mesh&, double distance) {
  return kTriangleShift * distance;
}

struct Tally {
  std::uint64_t hits = 0, missed_boxes = 0, points_outside = 0;
};

// Rays aimed at a sampled point of the shape's surface, which is often the outermost one.
template <class Shape>
void compare(const Shape& shape, const Vec3& target, Random& random, Tally& tally) {
  const Aabb box = bounds(shape);
  for (int k = 0; k < 4; ++k) {
    Ray ray;
    ray.direction = random.unit_vector();
    if (k == 3) {  // along an axis: zeros in the direction, grazing the box's faces
      ray.direction = Vec3::Zero();
      ray.direction[static_cast<Eigen::Index>(random.index(3))] = random.bits() % 2 ? 1 : -1;
    }
    ray.origin = target - random.scale(0.1, 1e3) * ray.direction;
    const auto hit = intersect(ray, shape);
    if (!hit) continue;
    ++tally.hits;
    tally.missed_boxes += !meets(ray, box);
    // The slabs must also keep a box that is cut off just behind the hit.
    tally.missed_boxes += !RayBoxTest(ray).meets(box, std::nextafter(hit->t, 2 * hit->t));
    tally.points_outside += !contains(box, hit->point, shift(shape, 2 * (ray.origin - target).norm()));
  }
}

// CLAIM      IU.5.7.1: bounds() contains every point that is hit, and the slab test never drops a hit: rays aimed at
//            the outermost points of each shape, in random frames, around the origin and far away.
// ORACLE     identity: what intersect() hits lies in the bounds.
// TOLERANCE  none; for triangles kTriangleShift, as documented at bounds().
TEST(Aabb, NoHitIsOutsideOfItsBounds) {
  proves({"IU.5.7.1"}, Oracle::identity, "what intersect() hits lies within the bounds");
  Random random(1001);
  Tally tally;
  for (int i = 0; i < 2'000; ++i) {
    const Vec3 c = random.in_cube(i % 2 ? 1 : 1e5);
    const Mat3 frame = random.rotation();
    const Vec3 n = frame.col(2);
    Vec3 axis = Vec3::Zero();
    axis[static_cast<Eigen::Index>(random.index(3))] = random.bits() % 2 ? 1 : -1;
    const Vec3 rim = axis - axis.dot(n) * n;
    const double r = random.scale(0.01, 10);
    compare(Sphere{c, r}, c + r * axis * (1 - 0x1p-40), random, tally);
    compare(Disc{c, n, r}, c + r * rim.normalized() * (1 - 0x1p-50), random, tally);
    compare(Cylinder{c, c + n, r}, c + (axis.dot(n) > 0 ? n : Vec3::Zero()) + r * rim.normalized() * (1 - 0x1p-40),
            random, tally);
    compare(Box{c, frame, Vec3(r, 1, 2)},
            c + frame * ((frame.transpose() * axis).cwiseSign().cwiseProduct(Vec3(r, 1, 2))), random, tally);
    const Triangle triangle{c + random.in_cube(r), c + random.in_cube(r), c + random.in_cube(r)};
    compare(triangle, random.bits() % 2 ? triangle.a : Vec3((triangle.b + triangle.c) / 2), random, tally);
    compare(Mesh{{triangle.a, triangle.b, triangle.c}, {{0, 1, 2}}}, triangle.b, random, tally);
    const auto polygon = Polygon::make({c, c + r * frame.col(0), c + r * (frame.col(0) + frame.col(1))});
    ASSERT_TRUE(polygon);
    compare(*polygon, c + r * frame.col(0), random, tally);
    compare(Cone{c, c + n, r, 0.3 * r}, c + r * rim.normalized() * (1 - 0x1p-40), random, tally);
    compare(Torus{c, 3 * n, 2 * r, r}, c + 2 * r * rim.normalized() + r * axis * (1 - 0x1p-40), random, tally);
    Quadric ball;  // the sphere of radius r, cut by a box
    ball.constant = -r * r;
    ball.box = {c, frame, Vec3(r, r, r / 2)};
    compare(ball, c + frame * Vec3(r * 0.8, r * 0.6, 0), random, tally);
    BezierSurface surface;
    for (auto& row : surface.control) {
      for (Vec3& p : row) p = c + random.in_cube(r);
    }
    compare(surface, surface.control[0][3], random, tally);
  }
  EXPECT_GT(tally.hits, 20'000u);
  EXPECT_TRUE(all_agree(tally.missed_boxes + tally.points_outside, tally.hits));
}

// CLAIM      IU.5.7.1: bounds are not idle: the box of a sphere is its cube to 2^-46, that of a disc to 2^-24; a ray
//            beside a box misses it, an empty box is missed by all.
// ORACLE     closed form: extents of sphere, disc and triangle.
// TOLERANCE  2^-46 and 2^-24 of the coordinates, as documented at bounds().
TEST(Aabb, BoundsAreTight) {
  proves({"IU.5.7.1"}, Oracle::closed_form, "extents of sphere, disc and triangle");
  constexpr double kLoose = 0x1p-46, kLooseRim = 0x1p-24;
  const Aabb ball = bounds(Sphere{{1, 2, 3}, 4});
  EXPECT_TRUE(within((ball.high - Vec3(5, 6, 7)).norm() + (ball.low - Vec3(-3, -2, -1)).norm(), 16 * kLoose));
  const Aabb disc = bounds(Disc{{1, 2, 3}, Vec3(0, 0.6, 0.8), 5});
  EXPECT_TRUE(within((disc.high - Vec3(6, 6, 6)).norm(), 5 * kLooseRim));
  const Aabb triangle = bounds(Triangle{{0, 0, 0}, {1, 0, 2}, {0, 3, -1}});
  EXPECT_TRUE(within((triangle.high - Vec3(1, 3, 2)).norm() + (triangle.low - Vec3(0, 0, -1)).norm(), 8 * kLoose));
  Ray ray;
  ray.origin = {-9, 0, 0};
  ray.direction = {1, 0, 0};
  EXPECT_TRUE(holds(meets(ray, Aabb{{-1, -1, -1}, {1, 1, 1}})));
  EXPECT_TRUE(holds(meets(ray, Aabb{{-1, 0, 0}, {1, 1, 1}}))) << "in a face";
  EXPECT_TRUE(holds(!meets(ray, Aabb{{-1, 0.001, -1}, {1, 1, 1}})));
  EXPECT_TRUE(holds(!meets(ray, Aabb{{-12, -1, -1}, {-10, 1, 1}}))) << "behind";
  ray.t_max = 7.9;
  EXPECT_TRUE(holds(!meets(ray, Aabb{{-1, -1, -1}, {1, 1, 1}}))) << "farther than the nearest so far";
  EXPECT_TRUE(holds(!meets(ray, Aabb{})));
  EXPECT_TRUE(holds(Aabb{}.empty()));
}

}  // namespace
}  // namespace etendue::validation
