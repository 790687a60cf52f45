// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/box.hpp"

#include "etendue/geometry/plane.hpp"
#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

std::optional<oracle::Interval> exact_interval(const Ray& ray, const Box& box) {
  return oracle::box_interval(
      exact(ray.origin), exact(ray.direction), exact(box.centre),
      {exact(Vec3(box.axes.col(0))), exact(Vec3(box.axes.col(1))), exact(Vec3(box.axes.col(2)))},
      exact(box.half_edges));
}

// A point of an edge of the box, in its own coordinates scaled to [−1, 1].
Vec3 on_an_edge(Random& random) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = random.bits() % 2 ? 1 : -1;
  p[static_cast<Eigen::Index>(random.index(3))] = random.uniform(-1, 1);
  return p;
}

// CLAIM      IU.5.0: a box in any frame is hit exactly where and when rational slabs say, from outside and inside; half
//            of the rays are aimed at its edges.
// ORACLE     exact: the slabs in rationals.
// TOLERANCE  none for the decision; kPlaneUlps for t; the hit's point_error.
TEST(Box, IsHitAsExactSlabsSay) {
  proves({"IU.5.0"}, Oracle::exact, "slabs in rationals");
  Random random(701);
  std::uint64_t mismatches = 0, rays = 0, hits = 0;
  double ulps = 0, point = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Box box{random.in_cube(100),
                  random.rotation(),
                  {random.scale(0.01, 10), random.scale(0.01, 10), random.scale(0.01, 10)}};
    const Vec3 target = i % 2 ? on_an_edge(random) : random.in_cube(1.5);
    Ray ray;
    ray.origin = i % 3 ? Vec3(box.centre + random.in_cube(50))
                       : Vec3(box.centre + box.axes * random.in_cube(1).cwiseProduct(box.half_edges));
    ray.direction = box.centre + box.axes * target.cwiseProduct(box.half_edges) - ray.origin;
    const auto truth = exact_interval(ray, box);
    const auto hit = intersect(ray, box);
    ++rays;
    mismatches += hit.has_value() != (truth && truth->last.high > 0);
    if (!hit || !truth) continue;
    ++hits;
    const oracle::Wide& t = truth->first.high > 0 ? truth->first : truth->last;
    ulps = std::max(ulps, oracle::ulps(hit->t, t));
    point = std::max(point, oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), t) /
                                hit->point_error);
  }
  EXPECT_GT(hits, rays / 4);
  EXPECT_LT(hits, rays);
  EXPECT_TRUE(all_agree(mismatches, rays));
  EXPECT_TRUE(within(ulps, kPlaneUlps));
  EXPECT_TRUE(within(point, 1));
}

// CLAIM      IU.5.0: a ray in a face belongs to the box, one beside it does not; a ray that leaves from a face misses.
// ORACLE     closed form: the cube [−1, 1]³.
// TOLERANCE  none.
TEST(Box, ClosedFacesBelongToIt) {
  proves({"IU.5.0"}, Oracle::closed_form, "the cube of edge 2");
  const Box cube{Vec3::Zero(), Mat3::Identity(), Vec3::Ones()};
  const auto hit = [&](const Vec3& origin, const Vec3& direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return intersect(ray, cube);
  };
  const auto in_face = hit({-3, 0, 1}, {1, 0, 0});
  ASSERT_TRUE(in_face);
  EXPECT_TRUE(holds(in_face->t == 2));
  EXPECT_TRUE(holds(in_face->normal == Vec3(-1, 0, 0)));
  EXPECT_TRUE(holds(!hit({-3, 0, std::nextafter(1.0, 2.0)}, {1, 0, 0})));
  EXPECT_TRUE(holds(!hit({1, 0, 0}, {1, 1, 0})));
  const auto out = hit({-1, 0, 0}, {2, 0, 0});
  ASSERT_TRUE(out);
  EXPECT_TRUE(holds(out->t == 1));
  EXPECT_TRUE(holds(out->normal == Vec3(1, 0, 0))) << "outward from inside, too";
  const auto corner = hit({3, 3, 3}, {-1, -1, -1});
  ASSERT_TRUE(corner);
  EXPECT_TRUE(holds(corner->point == Vec3(1, 1, 1)));
  EXPECT_TRUE(holds(!hit({0, 0, -3}, {0, 0, -1})));
}

}  // namespace
}  // namespace etendue::validation
