// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/point_round.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "etendue/form_factor/point_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/catalogue_truth.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

using oracle::Wide;
using oracle::WideVector;

/// 64 bits of significand, sums of terms of order one: what the quadrature of the oracle may err by.
constexpr double kOracle = 1e-16;

Vec3 direction(CounterRandom& random) {
  const double z = random.between(-1, 1), turn = random.between(0, 6.283185307179586);
  const double r = std::sqrt(1 - z * z);
  return Vec3(r * std::cos(turn), r * std::sin(turn), z).normalized();
}

WideVector wide(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
WideVector cross(const WideVector& a, const WideVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Wide length(const WideVector& a) {
  return std::sqrt(oracle::dot(a, a));
}

/// Lambert's contour, quadrature along the arc above the horizon, and the chord's angle.
double contour(const Vec3& point, const Vec3& normal, const Disc& disc) {
  const WideVector n = (1 / length(wide(normal))) * wide(normal),
                   m = (1 / length(wide(disc.normal))) * wide(disc.normal);
  const WideVector c = wide(disc.centre) - wide(point);
  const Wide r = disc.radius;
  if (oracle::dot(m, c) >= 0) return 0;
  const WideVector up = n - oracle::dot(n, m) * m;
  const Wide steep = length(up);
  const WideVector any = std::abs(m.x) < 0.5L ? WideVector{1, 0, 0} : WideVector{0, 1, 0};
  const WideVector u = steep > 1e-12L ? (1 / steep) * up : (1 / length(cross(m, any))) * cross(m, any), v = cross(m, u);
  const Wide level = oracle::dot(n, c), width = r * steep;
  if (level <= -width) return 0;
  const Wide half = level >= width ? oracle::kWidePi : std::acos(-level / width);
  const auto integrand = [&](Wide t) {
    const WideVector p = c + (r * std::cos(t)) * u + (r * std::sin(t)) * v;
    const WideVector turning = (-r * std::sin(t)) * u + (r * std::cos(t)) * v;
    return oracle::dot(n, cross(turning, p)) / oracle::dot(p, p);
  };
  // Cut where the rim comes nearest, and ever nearer to there: on each part the integrand is smooth.
  const Wide near = std::atan2(-oracle::dot(c, v), -oracle::dot(c, u));
  std::vector<Wide> cuts{-half, half};
  for (const Wide turn : {near - 2 * oracle::kWidePi, near, near + 2 * oracle::kWidePi}) {
    for (Wide step = oracle::kWidePi; step > 1e-8L; step /= 4) {
      for (const Wide cut : {turn - step, turn, turn + step}) {
        if (cut > -half && cut < half) cuts.push_back(cut);
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  Wide sum = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) sum += oracle::integrate(cuts[k], cuts[k + 1], integrand);
  if (level < width) {
    const WideVector a = c + (r * std::cos(half)) * u + (r * std::sin(half)) * v;
    const WideVector b = c + (r * std::cos(half)) * u - (r * std::sin(half)) * v;
    sum += std::atan2(length(cross(a, b)), oracle::dot(a, b));
  }
  return static_cast<double>(sum / (2 * oracle::kWidePi));
}

/// Anywhere, with a bias to what is difficult: near the plane, near the rim, on the axis, at the horizon's tangent.
struct View {
  Vec3 point, normal;
  Disc disc;
};
View random_view(CounterRandom& random, int family) {
  View view{Vec3::Zero(), direction(random), {Vec3::Zero(), direction(random), random.scale(0.01, 10)}};
  const double r = view.disc.radius;
  const Vec3 u = view.disc.normal.unitOrthogonal();
  double aside = r * random.scale(0.01, 100), height = r * random.scale(0.01, 100);
  if (family == 1) height = r * random.scale(1e-9, 1e-3), aside = r * random.between(0, 3);
  if (family == 2) aside = r * random.scale(1e-14, 1e-6);
  if (family == 3) aside = r * (1 + random.scale(1e-6, 1e-2)), height = r * random.scale(1e-6, 1e-2);
  view.disc.centre = aside * u - height * view.disc.normal;
  if (family == 4) {  // the horizon touches the rim but for a little
    const Vec3 rim = view.disc.centre + r * (std::cos(1.0) * u + std::sin(1.0) * view.disc.normal.cross(u));
    const Vec3 along = view.disc.normal.cross(rim - view.disc.centre);
    view.normal = along.cross(rim).normalized();
    if (view.normal.dot(view.disc.centre) < 0) view.normal = -view.normal;
    view.normal = (view.normal + random.between(-1, 1) * random.scale(1e-12, 1e-3) * direction(random)).normalized();
  }
  view.point = family == 0 ? Vec3(0.25 * direction(random)) : Vec3::Zero();
  view.disc.centre += view.point;
  return view;
}

// CLAIM      IU.6-2, G12: an element's factor to a disc in any position, cut by the horizon or not, is within its bound.
// ORACLE     closed form: Lambert's contour by double-exponential quadrature, 64-bit significand.
// TOLERANCE  the returned bound, and 1e-16 of the oracle; as promised the bound is below 1e-15.
TEST(PointToDisc, MeetsTheContourInEveryPosition) {
  constexpr std::uint64_t kSeed = 41;
  proves({"IU.6-2", "IU.6-10", "G12"}, Oracle::closed_form,
         "contour of 600 discs in five families; in a long run of more");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  int cut = 0, loose = 0;
  const std::uint64_t discs = long_run(600);
  for (std::uint64_t k = 0; k < discs; ++k) {
    const View view = random_view(random, static_cast<int>(k % 5));
    const Bounded factor = point_to_disc(view.point, view.normal, view.disc);
    // Near the rim the integrand of the oracle is large: it errs by its height.
    const double height = std::abs((view.point - view.disc.centre).dot(view.disc.normal)) / view.disc.radius;
    EXPECT_TRUE(near(factor.value, contour(view.point, view.normal, view.disc),
                     factor.bound + kOracle * (1 + 0x1p-10 / height)))
        << k;
    cut += factor.value > 0 && (view.disc.centre - view.point).dot(view.normal) <
                                   view.disc.radius * view.disc.normal.cross(view.normal).norm();
    loose += factor.bound > 1e-15;
  }
  EXPECT_GT(static_cast<std::uint64_t>(cut), discs / 5);
  EXPECT_TRUE(all_agree(static_cast<std::uint64_t>(loose), discs));
}

// CLAIM      IU.6-2: the factor to a disc lies between those to an inscribed and a circumscribed polygon.
// ORACLE     metamorphic: Lambert's sum over 96 edges.
// TOLERANCE  the returned bounds.
TEST(PointToDisc, LiesBetweenPolygons) {
  constexpr std::uint64_t kSeed = 42;
  constexpr int kEdges = 96;
  proves({"IU.6-2"}, Oracle::metamorphic, "inscribed and circumscribed polygons of 96 edges");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  for (int k = 0; k < 300; ++k) {
    const View view = random_view(random, 0);
    const Vec3 u = view.disc.normal.unitOrthogonal(), v = view.disc.normal.cross(u);
    const auto ring = [&](double radius) {
      std::vector<Vec3> corners;
      for (int e = 0; e < kEdges; ++e) {
        const double turn = 2 * std::numbers::pi * e / kEdges;
        corners.push_back(view.disc.centre + radius * (std::cos(turn) * u + std::sin(turn) * v));
      }
      return polygon(std::move(corners));
    };
    const Bounded factor = point_to_disc(view.point, view.normal, view.disc);
    // A little within and without, for the rounding of the corners.
    const double r = view.disc.radius, outer = r / std::cos(std::numbers::pi / kEdges) * (1 + 0x1p-40);
    const Bounded least = point_to_polygon(view.point, view.normal, ring(r * (1 - 0x1p-40)));
    const Bounded most = point_to_polygon(view.point, view.normal, ring(outer));
    const double slack = factor.bound + least.bound + most.bound;
    EXPECT_TRUE(within(std::max({0.0, least.value - factor.value, factor.value - most.value}), slack)) << k;
  }
}

// CLAIM      IU.6-2: the factor to a sphere in any position; it is that of the disc on its circle of tangents.
// ORACLE     closed form: rings of directions by double-exponential quadrature; metamorphic: point_to_disc, whose closed form
//            shares nothing with that of the sphere.
// TOLERANCE  the returned bounds; the quadrature errs by 2^-48, the disc's rounded place by 2^-46.
TEST(PointToSphere, MeetsRingsOfDirectionsAndItsTangentDisc) {
  constexpr std::uint64_t kSeed = 43;
  proves({"IU.6-2", "G12"}, Oracle::closed_form, "rings of directions; the disc on the circle of tangents");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  for (int k = 0; k < 1500; ++k) {
    const double radius = random.scale(1e-4, 10), distance = radius * (1 + random.scale(1e-9, 1e4));
    const Vec3 way = direction(random), normal = direction(random);
    Vec3 centre = distance * way;
    if (k % 4 == 0) {  // the horizon touches it but for a little
      const Vec3 aside = normal.unitOrthogonal();
      const double height = radius * (1 + random.between(-1, 1) * random.scale(1e-12, 1e-2)) * (k % 8 == 0 ? 1 : -1);
      centre = height * normal + std::sqrt(std::max(distance * distance - height * height, radius * radius)) * aside;
    }
    const Bounded factor = point_to_sphere(Vec3::Zero(), normal, {centre, radius});
    const WideVector c = wide(centre), n = (1 / length(wide(normal))) * wide(normal);
    const Wide height = oracle::dot(n, c), aside = length(cross(n, c));
    const double truth = height <= -radius ? 0 : static_cast<double>(oracle::element_to_sphere(height, aside, radius));
    EXPECT_TRUE(near(factor.value, truth, factor.bound + 0x1p-48)) << k;
    if (distance < 1.01 * radius) continue;  // the circle of tangents comes too near the element
    const double share = (radius / centre.norm()) * (radius / centre.norm());
    const Disc tangents{(1 - share) * centre, -centre.normalized(), radius * std::sqrt(1 - share)};
    const Bounded other = point_to_disc(Vec3::Zero(), normal, tangents);
    EXPECT_TRUE(near(factor.value, other.value, factor.bound + other.bound + 0x1p-46)) << k;
  }
}

// CLAIM      Lengths times a power of two change no bit; far, tiny and touching things keep their relative accuracy;
//            elements in a disc's plane, behind it or inside a sphere get what the contract says.
// ORACLE     identity: the same view in other units; closed form: limits (r/d)² and ½.
// TOLERANCE  none for bits; 1e-15 relatively for the limits.
TEST(PointToDisc, KeepsItsContractAtTheEdges) {
  constexpr std::uint64_t kSeed = 44;
  proves({"IU.6-2"}, Oracle::identity, "powers of two; limits");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::uint64_t differ = 0;
  for (int k = 0; k < 200; ++k) {
    const View view = random_view(random, k % 5);
    const double scale = std::ldexp(1.0, static_cast<int>(random.below(200)) - 100);
    const Disc disc{scale * view.disc.centre, view.disc.normal, scale * view.disc.radius};
    const Bounded one = point_to_disc(view.point, view.normal, view.disc);
    const Bounded other = point_to_disc(scale * view.point, view.normal, disc);
    differ += one.value != other.value || one.bound != other.bound;
  }
  EXPECT_TRUE(all_agree(differ, 200));
  const Vec3 up = Vec3::UnitZ(), o = Vec3::Zero();
  EXPECT_TRUE(near(point_to_disc(o, up, {{0, 0, 1e60}, -up, 1}).value, 1e-120, 1e-135));
  EXPECT_TRUE(near(point_to_sphere(o, up, {{0, 0, 1e60}, 1}).value, 1e-120, 1e-135));
  EXPECT_TRUE(near(point_to_disc(o, up, {{0, 0, 1e-12}, -up, 1}).value, 1, 1e-15));
  EXPECT_TRUE(near(point_to_sphere(o, Vec3::UnitX(), {{0, 0, 1}, 1}).value, 0.5, 1e-15));
  EXPECT_TRUE(holds(point_to_disc(o, up, {{3, 0, 0}, -up, 1}).value == 0 &&
                    point_to_disc(o, up, {{3, 0, 0}, -up, 1}).bound == 0));
  EXPECT_TRUE(holds(point_to_disc(o, up, {{0, 0, 1}, up, 1}).value == 0));
  EXPECT_TRUE(holds(point_to_sphere(o, -up, {{0, 0, 1}, 1}).value == 0));
  EXPECT_TRUE(refuses([&] { (void)point_to_sphere(o, up, {{0, 0, 0.5}, 1}); }));
  EXPECT_TRUE(refuses([&] { (void)point_to_disc(o, Vec3(0, 0, 2), {{0, 0, 1}, -up, 1}); }));
}

// CLAIM      a disc without extent, or without end, is refused.
// ORACLE     identity: the domain as documented.
// TOLERANCE  none.
TEST(PointToDisc, RefusesWhatIsNoDisc) {
  proves({}, Oracle::identity, "discs outside the domain");
  const auto factor = [](double radius) {
    return point_to_disc(Vec3::Zero(), Vec3::UnitZ(), Disc{{0, 0, 1}, {0, 0, -1}, radius});
  };
  EXPECT_TRUE(holds(factor(1).value > 0));
  for (const double radius : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_TRUE(refuses([&] { return factor(radius); }));
  }
}

}  // namespace
}  // namespace etendue::validation
