// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/bezier.hpp"

#include <cmath>

#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "oracles/line_roots.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// z = a x² + b y² + c x y over [0, 3]², moved by `by`: exactly bicubic.
BezierSurface paraboloid(double a, double b, double c, const Vec3& by) {
  const std::array<double, 4> linear{0, 1, 2, 3}, square{0, 0, 3, 9};
  BezierSurface surface;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3 p(linear[i], linear[j], a * square[i] + b * square[j] + c * linear[i] * linear[j]);
      surface.control[i][j] = p + by;
    }
  }
  return surface;
}

// A third grazes, 2^-1 … 2^-25 beside the surface.
Ray aimed_ray(Random& random, const BezierSurface& surface, int i) {
  const double u = random.uniform(-0.1, 1.1), v = random.uniform(-0.1, 1.1);
  const BezierPoint at_target = at(surface, u, v);
  const Vec3 any = random.unit_vector(), normal = at_target.along_u.cross(at_target.along_v).normalized();
  const bool grazes = i % 3 == 0;
  const double halvings = 1 + static_cast<double>(random.index(25));
  const Vec3 target = at_target.point + (grazes ? random.uniform(-1, 1) * std::exp2(-halvings) : 0) * normal;
  const Vec3 along = grazes ? normal.cross(any).normalized() : any;
  Ray ray;
  ray.origin = target - along * random.scale(0.1, 1e3);
  ray.direction = (target - ray.origin) * random.scale(0.1, 10);
  return ray;
}

// CLAIM      IU.5.0: a parametric surface is hit where and when exact arithmetic says, also by grazing rays, along the
//            rulings of a saddle, and near its edges.
// ORACLE     exact: paraboloids and saddles are quadrics as well as bicubic; their quadratic with rational coefficients.
// TOLERANCE  the hit's own point_error; decisions are open where a root lies within 2^-27 of an edge (the test's own point
//            is in double, from up to 1e3 away, t up to some 2^-40 of that), and nowhere else.
TEST(BezierSurface, IsHitAsTheExactQuadraticSays) {
  proves({"IU.5.0"}, Oracle::exact, "rational quadratic, isolated roots");
  uses_seed(841);
  Random random(841);
  std::uint64_t mismatches = 0, rays = 0, hits = 0, open = 0;
  double point = 0, largest_error = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 bend = random.dyadic(1, 6), by = random.dyadic(100, 10);
    const BezierSurface surface = paraboloid(bend.x(), bend.y(), bend.z(), by);
    const Ray ray = aimed_ray(random, surface, i);
    const std::array<oracle::Point, 3> square{oracle::Point{bend.x(), bend.z() / 2, 0},
                                              oracle::Point{bend.z() / 2, bend.y(), 0}, oracle::Point{0, 0, 0}};
    std::optional<oracle::Wide> truth;
    bool undecided = false;
    for (const oracle::Wide& t :
         oracle::quadric_roots(exact(ray.origin), exact(ray.direction), exact(by), square, {0, 0, -0.5}, 0).changes) {
      const Vec3 p = ray.at(t.high) - by;
      const double inside = std::min({p.x(), 3 - p.x(), p.y(), 3 - p.y()});
      undecided = undecided || std::abs(inside) < 0x1p-27;
      if (!truth && t.high > 0 && inside > 0) truth = t;
    }
    open += undecided;
    if (undecided) continue;
    const auto hit = intersect(ray, surface);
    ++rays;
    mismatches += hit.has_value() != truth.has_value();
    if (!hit || !truth) continue;
    ++hits;
    const double error = oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), *truth);
    point = std::max(point, error / hit->point_error);
    largest_error = std::max(largest_error, hit->point_error);
  }
  EXPECT_GT(hits, rays / 4);
  EXPECT_LT(open, rays / 1000 + 1);
  EXPECT_TRUE(all_agree(mismatches, rays));
  EXPECT_TRUE(within(point, 1));
  EXPECT_LT(largest_error, 1e-6) << "no bound is empty, even next to a tangent";
}

// CLAIM      IU.5.0: on surfaces of full degree that fold over themselves the nearest of up to nine crossings is found.
// ORACLE     exact: all common zeros of two bicubic polynomials by their resultants, with integer coordinates.
// TOLERANCE  the hit's own point_error; decisions are open where a crossing lies within 2^-30 of an edge.
TEST(BezierSurface, IsHitAsTheResultantSays) {
  proves({"IU.5.0"}, Oracle::exact, "resultants of integer polynomials, isolated roots");
  uses_seed(842);
  Random random(842);
  const auto whole = [&](double half_edge) {
    const Vec3 p = random.in_cube(half_edge);
    return Vec3(std::round(p.x()), std::round(p.y()), std::round(p.z()));
  };
  std::uint64_t mismatches = 0, rays = 0, hits = 0, many = 0;
  double point = 0, parameters = 0;
  for (int i = 0; i < 200; ++i) {
    BezierSurface surface;
    std::array<std::array<oracle::Point, 4>, 4> control;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t l = 0; l < 4; ++l) {
        // A third are nets in order, the others are folded at random.
        const Vec3 order(30.0 * static_cast<double>(k) - 45, 30.0 * static_cast<double>(l) - 45, 0);
        surface.control[k][l] = i % 3 == 0 ? Vec3(order + whole(30)) : whole(60);
        control[k][l] = exact(surface.control[k][l]);
      }
    }
    Ray ray;
    ray.origin = whole(200);
    ray.direction = whole(20) - ray.origin;
    if (ray.direction.isZero()) continue;
    std::optional<oracle::SurfaceCrossing> truth;
    bool undecided = false;
    std::size_t ahead = 0;
    for (const auto& crossing : oracle::bezier_crossings(exact(ray.origin), exact(ray.direction), control)) {
      const double inside = std::min({crossing.u, 1 - crossing.u, crossing.v, 1 - crossing.v});
      undecided = undecided || inside < 0x1p-30;
      if (crossing.t.high > 0) ++ahead;
      if (!truth && crossing.t.high > 0) truth = crossing;
    }
    if (undecided) continue;
    const auto hit = intersect(ray, surface);
    ++rays;
    many += ahead > 2;
    mismatches += hit.has_value() != truth.has_value();
    if (!hit || !truth) continue;
    ++hits;
    const double error = oracle::distance_along(exact(hit->point), exact(ray.origin), exact(ray.direction), truth->t);
    point = std::max(point, error / hit->point_error);
    parameters = std::max(parameters, (hit->uv - Vec2(truth->u, truth->v)).norm());
  }
  EXPECT_GT(hits, rays / 4);
  EXPECT_GT(many, 5U) << "some rays cross more than twice";
  EXPECT_TRUE(all_agree(mismatches, rays));
  EXPECT_TRUE(within(point, 1));
  // Parameters are as good as the point over the least stretch of the map, here above 2^-12 of the size.
  EXPECT_TRUE(within(parameters, 0x1p-36));
}

// CLAIM      IU.5.0: neighbours with a common edge leave no gap; a flat piece in which the ray lies is a miss; an edge
//            drawn together to a point still has a normal; an origin on the surface is not hit at 0.
// ORACLE     closed form: flat and cut-up squares, a triangle as a degenerate patch.
// TOLERANCE  none.
TEST(BezierSurface, HasEdgesAndPoles) {
  proves({"IU.5.0"}, Oracle::closed_form, "flat surfaces over squares");
  const auto plane = [](double from) {  // [from, from + 3] × [0, 3] at z = 0
    return paraboloid(0, 0, 0, {from, 0, 0});
  };
  std::uint64_t lost = 0;
  Random random(843);
  for (int i = 0; i < 2'000; ++i) {
    Ray ray;
    const Vec3 target(3, random.uniform(0, 3), 0);
    ray.origin = target + Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.scale(1e-3, 1e3));
    ray.direction = target - ray.origin;
    lost += !intersect(ray, plane(0)) && !intersect(ray, plane(3));
  }
  EXPECT_TRUE(all_agree(lost, 2'000));
  Ray ray;
  ray.origin = {-1, 1, 0};
  ray.direction = Vec3::UnitX();
  EXPECT_TRUE(holds(!intersect(ray, plane(0)))) << "within the flat surface";
  ray.origin = {1, 1, 0};
  ray.direction = Vec3::UnitZ();
  EXPECT_TRUE(holds(!intersect(ray, plane(0)))) << "from the surface";
  BezierSurface tip = plane(0);
  for (Vec3& p : tip.control[3]) p = {3, 1.5, 0};
  ray.origin = {3, 1.5, 5};
  ray.direction = {0, 0, -1};
  const auto pole = intersect(ray, tip);
  ASSERT_TRUE(pole);
  EXPECT_TRUE(near(pole->t, 5, pole->point_error));
  EXPECT_TRUE(holds(std::abs(pole->normal.z()) == 1));
  tip.control[1][1].x() = NAN;
  EXPECT_TRUE(refuses([&] { (void)intersect(ray, tip); }));
}

}  // namespace
}  // namespace etendue::validation
