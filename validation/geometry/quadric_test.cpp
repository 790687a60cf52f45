// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/quadric.hpp"

#include <cmath>

#include "geometry/crossings.hpp"
#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "oracles/line_roots.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

Quadric random_quadric(Random& random) {
  Quadric quadric;
  const Mat3 frame = random.rotation();
  const Vec3 curvature = random.in_cube(2);
  quadric.square = frame * curvature.asDiagonal() * frame.transpose();  // not symmetric to the last bit
  quadric.linear = random.in_cube(1);
  quadric.constant = random.uniform(-1, 1);
  quadric.box.centre = random.in_cube(100);
  quadric.box.axes = random.rotation();
  for (double& edge : quadric.box.half_edges) edge = random.scale(0.5, 3);
  return quadric;
}

std::array<oracle::Point, 3> rows_of(const Mat3& m) {
  return {oracle::Point{m(0, 0), m(0, 1), m(0, 2)}, oracle::Point{m(1, 0), m(1, 1), m(1, 2)},
          oracle::Point{m(2, 0), m(2, 1), m(2, 2)}};
}

/// Largest coordinate in the box's frame, in half edges.
double place_in_box(const Quadric& quadric, const Vec3& point) {
  const Vec3 y = quadric.box.axes.transpose() * (point - quadric.box.centre);
  return y.cwiseQuotient(quadric.box.half_edges).lpNorm<Eigen::Infinity>();
}

/// To first order, |f|/|∇f|: f is small where it is asked.
double distance_from(const Quadric& quadric, const Vec3& point) {
  using Wide3 = Eigen::Matrix<long double, 3, 1>;
  const Wide3 x = point.cast<long double>() - quadric.box.centre.cast<long double>();
  const Eigen::Matrix<long double, 3, 3> q = quadric.square.cast<long double>();
  const Wide3 linear = quadric.linear.cast<long double>();
  const long double f = x.dot(q * x) + 2 * linear.dot(x) + static_cast<long double>(quadric.constant);
  const Wide3 gradient = (q + q.transpose()) * x + 2 * linear;
  return static_cast<double>(std::abs(f) / gradient.norm());
}

// CLAIM      IU.5.0: a general quadric, cut by a box, is hit where and when the exact quadratic says.
// ORACLE     exact: the quadratic with rational coefficients, roots isolated by Arb.
// TOLERANCE  kQuadricUlps for t; the hit's own point_error; decisions are open where a root lies within 2^-30 of a face of
//            the box (the test's own point is in double, from up to 1e4 away: 1e4 · 2^-52 · 8 < 2^-30), and nowhere else.
TEST(Quadric, IsHitAsTheExactQuadraticSays) {
  proves({"IU.5.0"}, Oracle::exact, "rational quadratic, isolated roots");
  uses_seed(831);
  Random random(831);
  std::uint64_t mismatches = 0, rays = 0, hits = 0, open = 0;
  double ulps = 0, point = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Quadric quadric = random_quadric(random);
    const Vec3 target = quadric.box.centre + quadric.box.axes * quadric.box.half_edges.cwiseProduct(random.in_cube(1));
    Ray ray;
    ray.origin = target + random.unit_vector() * random.scale(0.1, 1e4);
    ray.direction = (target - ray.origin) * random.scale(0.1, 10);
    const auto roots = oracle::quadric_roots(exact(ray.origin), exact(ray.direction), exact(quadric.box.centre),
                                             rows_of(quadric.square), exact(quadric.linear), quadric.constant);
    std::optional<oracle::Wide> truth;
    bool undecided = false;
    for (const oracle::Wide& t : roots.changes) {
      const double place = place_in_box(quadric, ray.at(t.high));
      undecided = undecided || std::abs(place - 1) < 0x1p-30;
      if (!truth && t.high > 0 && place <= 1) truth = t;
    }
    open += undecided;
    if (undecided) continue;
    const auto hit = intersect(ray, quadric);
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
  EXPECT_TRUE(within(ulps, kQuadricUlps));
  EXPECT_TRUE(within(point, 1));
}

// CLAIM      IU.5.0: every crossing of a line is found, one after the other, and none that is not there; each point lies on
//            the quadric.
// ORACLE     exact: the number of sign changes by Sturm's sequence; in boxes that cut nothing off.
// TOLERANCE  1e-12 max(1, way of the ray) off the surface, |f|/|∇f| evaluated in long double; counts none.
TEST(Quadric, CountsItsCrossingsAsSturmDoes) {
  proves({"IU.5.0"}, Oracle::exact, "Sturm's sequence of the rational quadratic");
  uses_seed(832);
  Random random(832);
  const std::uint64_t cases = long_run(20'000);
  std::uint64_t wrong = 0, lines = 0, counts[3] = {};
  double off = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    Quadric quadric = random_quadric(random);
    const Vec3 target = quadric.box.centre + random.in_cube(1);
    quadric.box.half_edges.setConstant(1e15);
    Ray ray;
    ray.origin = target + random.unit_vector() * random.scale(0.1, 1e4);
    ray.direction = (target - ray.origin) * random.scale(0.1, 10);
    const long truth = oracle::quadric_crossings(exact(ray.origin), exact(ray.direction), exact(quadric.box.centre),
                                                 rows_of(quadric.square), exact(quadric.linear), quadric.constant);
    const Crossings found =
        crossings(ray, quadric, 2, [&](const Vec3& point) { return distance_from(quadric, point); });
    ++lines;
    wrong += found.count != truth;
    ++counts[std::min(found.count, 2L)];
    off = std::max(off, found.off);
  }
  for (const std::uint64_t count : counts) EXPECT_GT(count, 0U) << "0 to 2 crossings all occur";
  EXPECT_TRUE(all_agree(wrong, lines));
  EXPECT_TRUE(within(off, 1e-12));
}

// CLAIM      IU.5.0: one formula serves paraboloid, hyperboloid, saddle, ellipsoid and a pair of planes; a tangent and a
//            double plane are misses; normals lie along the gradient.
// ORACLE     closed form: each around the origin, with small dyadic numbers.
// TOLERANCE  none.
TEST(Quadric, IsManySurfaces) {
  proves({"IU.5.0"}, Oracle::closed_form, "quadrics with small dyadic numbers");
  const auto hit = [](const Vec3& diagonal, const Vec3& linear, double constant, const Vec3& origin,
                      const Vec3& direction) {
    Quadric quadric{diagonal.asDiagonal(), linear, constant, {Vec3::Zero(), Mat3::Identity(), {2, 2, 2}}};
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return intersect(ray, quadric);
  };
  const auto bowl = hit({1, 1, 0}, {0, 0, -0.5}, 0, {1, 0, 4}, {0, 0, -1});  // z = x² + y²
  ASSERT_TRUE(bowl);
  EXPECT_TRUE(holds(bowl->t == 3 && bowl->normal == Vec3(1, 0, -0.5).normalized()));
  EXPECT_TRUE(holds(bowl->uv == Vec2(0.5, 0)));
  EXPECT_TRUE(holds(hit({1, 1, -1}, {0, 0, 0}, -1, {4, 0, 0}, {-1, 0, 0})->t == 3)) << "hyperboloid of one sheet";
  EXPECT_TRUE(holds(!hit({1, 1, -1}, {0, 0, 0}, 1, {4, 0, 0}, {-1, 0, 0}))) << "between two sheets";
  EXPECT_TRUE(holds(hit({1, 1, -1}, {0, 0, 0}, 1, {0, 0, 3}, {0, 0, -1})->t == 2)) << "hyperboloid of two sheets";
  EXPECT_TRUE(holds(hit({1, -1, 0}, {0, 0, -0.5}, 0, {0, 1, 1}, {0, 0, -1})->t == 2)) << "saddle";
  EXPECT_TRUE(holds(hit({4, 1, 1}, {0, 0, 0}, -1, {4, 0, 0}, {-1, 0, 0})->t == 3.5)) << "ellipsoid";
  EXPECT_TRUE(holds(hit({1, 0, 0}, {0, 0, 0}, -1, {4, 0, 0}, {-1, 0, 0})->t == 3)) << "two planes";
  EXPECT_TRUE(holds(!hit({1, 0, 0}, {0, 0, 0}, 0, {4, 0, 0}, {-1, 0, 0}))) << "a double plane has no inside";
  EXPECT_TRUE(holds(!hit({1, 1, 1}, {0, 0, 0}, -1, {-4, 0, 1}, {1, 0, 0}))) << "tangent to the sphere";
  EXPECT_TRUE(holds(!hit({1, 1, 0}, {0, 0, -0.5}, 0, {1.75, 0, 4}, {0, 0, -1}))) << "above the box";
}

// CLAIM      coefficients that are not finite and a box without an inside are refused.
// ORACLE     closed form: the domain.
// TOLERANCE  none.
TEST(Quadric, RefusesWhatIsNone) {
  proves({}, Oracle::closed_form, "the domain as documented");
  const Ray ray;
  Quadric quadric;
  quadric.box = {Vec3::Zero(), Mat3::Identity(), {1, 1, 0}};
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, quadric); }));
  quadric.box.half_edges.z() = 1;
  quadric.constant = NAN;
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, quadric); }));
}

}  // namespace
}  // namespace etendue::validation
