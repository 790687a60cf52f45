// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/bump.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/surface_chart.hpp"
#include "etendue/raytracing/shading_normal.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Long = long double;
using Long3 = Eigen::Matrix<Long, 3, 1>;
constexpr Long kPi = std::numbers::pi_v<Long>;

Vec3 random_unit(CounterRandom& random) {
  const double z = random.between(-1, 1), turn = random.between(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// Fourth-order difference of a function of one number, step 1e-3: rounding 1e-16, truncation 1e-12 of the fifth derivative / 30.
template <class Function>
Long3 slope(const Function& function, Long at) {
  const Long h = 1e-3L;
  return ((function(at - 2 * h) - function(at + 2 * h)) + 8 * (function(at + h) - function(at - h))) / (12 * h);
}

/// A torus that is displaced along its normal by ε a (cos 2πmu cos 2πnv + …): a sum of two waves, in long double.
struct Displaced {
  Torus torus;
  Long epsilon = 0;

  static Long height(Long u, Long v) { return std::cos(6 * kPi * u) * std::cos(4 * kPi * v); }
  Long3 at(Long u, Long v) const {
    const TangentFrame frame = tangent_frame(torus.axis);
    const Long3 a = torus.axis.cast<Long>(), e = frame.u.cast<Long>(), f = frame.v.cast<Long>();
    const Long3 radial = std::cos(2 * kPi * u) * e + std::sin(2 * kPi * u) * f;
    const Long3 normal = std::cos(2 * kPi * v) * radial + std::sin(2 * kPi * v) * a;
    return torus.centre.cast<Long>() + torus.ring * radial + (torus.tube + epsilon * height(u, v)) * normal;
  }
  Vec3 normal(Long u, Long v) const {
    const Long3 along_u = slope([&](Long x) { return at(x, v); }, u);
    const Long3 along_v = slope([&](Long x) { return at(u, x); }, v);
    return along_u.cross(along_v).normalized().cast<double>();
  }
};

// CLAIM      IU.4.2.1: the perturbed normal is that of the surface q + f n to the first order in f: what it is wrong by is quartered
//            when f is halved, on a torus in a random frame under waves along both of its coordinates.
// ORACLE     closed form: the displaced torus in long double, its tangents by fourth-order differences.
// TOLERANCE  the observed order is 2 within 0.05; the differences err by h⁴/30 of (6π)⁵ ε, 1e-10 at the last step, where 8e-7 is measured.
TEST(Bump, HasTheNormalOfTheDisplacedSurfaceToFirstOrder) {
  proves({"IU.4.2.1", "IU.f23"}, Oracle::closed_form, "normals of a displaced torus in long double");
  uses_seed(31);
  CounterRandom random(31);
  Torus torus{Vec3(0.3, -1.2, 0.7), random_unit(random), 2, 0.7};
  std::array<double, 5> worst{};
  for (int k = 0; k < 400; ++k) {
    const double u = random.between(0.01, 0.99), v = random.between(0.01, 0.99);
    for (std::size_t level = 0; level < worst.size(); ++level) {
      const double epsilon = std::ldexp(0.01, -static_cast<int>(level));
      const Displaced smooth{torus, 0}, rough{torus, epsilon};
      const Vec3 point = smooth.at(u, v).cast<double>();
      MaterialBump bump;
      bump.relief = WaveRelief{epsilon, 3, 2};
      const Vec3 found = shading_normal(bump, torus, point, smooth.normal(u, v));
      worst[level] = std::max(worst[level], (found - rough.normal(u, v)).norm());
    }
  }
  constexpr double kOrder = 0.05;
  for (std::size_t level = 1; level < worst.size(); ++level) {
    EXPECT_TRUE(within(std::abs(std::log2(worst[level - 1] / worst[level]) - 2), kOrder)) << worst[level];
  }
  EXPECT_GT(worst.back(), 1e-7);  // far above what the differences err by
}

// CLAIM      IU.4.2.1: bumped_normal() of height_gradient() is Blinn's vector, whatever the angle between the coordinates; it is
//            less than 90° from the normal, however steep the bump.
// ORACLE     identity: n |Q_u × Q_v| + f_u (n × Q_v) − f_v (n × Q_u) in long double.
// TOLERANCE  12 u over the sine between the tangents, at least 0.3 here, once more for it is squared: 12 u / 0.09.
TEST(Bump, IsBlinnsFormula) {
  proves({"IU.4.2.1"}, Oracle::identity, "Blinn's cross products in long double");
  uses_seed(32);
  CounterRandom random(32);
  constexpr double kTolerance = 12 / 0.09 * kUnitRoundoff;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 along_u = random.scale(1e-3, 1e3) * random_unit(random);
    const Vec3 along_v = random.scale(1e-3, 1e3) * random_unit(random);
    const Vec3 across = along_u.cross(along_v);
    if (across.norm() < 0.3 * along_u.norm() * along_v.norm()) continue;
    const double steep = random.scale(1e-3, 1e3), turn = random.between(0, 6);
    const Relief slopes{0, steep * std::cos(turn) * along_u.norm(), steep * std::sin(turn) * along_v.norm()};
    const Vec3 normal = across.normalized();
    const Long3 q_u = along_u.cast<Long>(), q_v = along_v.cast<Long>(), n = q_u.cross(q_v).normalized();
    const Long3 blinn = n * q_u.cross(q_v).norm() + slopes.along_u * n.cross(q_v) - slopes.along_v * n.cross(q_u);
    const Vec3 found = bumped_normal(normal, height_gradient(along_u, along_v, slopes));
    EXPECT_TRUE(within((found.cast<Long>() - blinn.normalized()).cast<double>().norm(), kTolerance));
    EXPECT_TRUE(holds(found.dot(normal) > 0));
  }
  const Relief any{1, 2, 3};
  EXPECT_TRUE(holds(height_gradient(Vec3::Zero(), Vec3(0, 1, 0), any).isZero(0)));  // a pole
  EXPECT_TRUE(refuses([] { (void)bumped_normal(Vec3(0, 0, 2), Vec3::Zero()); }));
}

/// How far tangents are from what their shape says: rotation about the axis, orthogonality, the length of a meridian.
template <class Shape>
void check_chart(const Shape& shape, const Vec3& axis, const Vec3& on_axis, double meridian, CounterRandom& random) {
  int met = 0;
  for (int k = 0; k < 300; ++k) {
    Ray ray;
    ray.origin = on_axis + 6 * random_unit(random);
    ray.direction = (on_axis + random_unit(random) - ray.origin).normalized();
    const auto hit = intersect(ray, shape);
    if (!hit) continue;
    ++met;
    const ChartPoint at = chart(shape, hit->point);
    constexpr double kTolerance =
        64 * kUnitRoundoff;  // lengths are below 16, and 2π at most divides by tangents of 0.05
    const double around = std::abs(at.u - hit->uv.x());
    EXPECT_TRUE(within(std::min(around, 1 - around), 1e4 * kUnitRoundoff));  // u near an axis errs by u/distance
    EXPECT_TRUE(near(at.v, hit->uv.y(), 1e4 * kUnitRoundoff));
    EXPECT_TRUE(within((at.along_u - 2 * std::numbers::pi * axis.cross(hit->point - on_axis)).norm(), 16 * kTolerance));
    EXPECT_TRUE(near(at.along_v.norm(), meridian, 16 * kTolerance));
    EXPECT_TRUE(within(std::abs(at.along_v.dot(hit->normal)), 64 * kTolerance));
    EXPECT_TRUE(within(std::abs(at.along_v.dot(at.along_u)), 256 * kTolerance));
    EXPECT_TRUE(holds(at.along_u.cross(at.along_v).dot(hit->normal) > 0));
  }
  EXPECT_GT(met, 60);
}

// CLAIM      IU.4.2.1, of surfaces Q(u, v): chart() has the coordinates of the hit, and tangents that turn about the axis by 2π a
//            unit of u, run along the meridian for its whole length, lie in the surface and span it outwards.
// ORACLE     identity: Q_u = 2π A × (p − c), Q_v ⟂ n, Q_v ⟂ Q_u, |Q_v| the meridian's length; Hit::uv.
// TOLERANCE  in header units of the lengths (below 16): 1024 u for vectors; 10⁴ u for coordinates, which divide by the distance from the axis.
TEST(Bump, KnowsTheTangentsOfRoundShapes) {
  proves({"IU.4.2.1"}, Oracle::identity, "rotation, orthogonality and lengths of meridians");
  uses_seed(33);
  CounterRandom random(33);
  const Vec3 axis = random_unit(random), centre(0.4, -0.3, 0.9);
  constexpr double kPiD = std::numbers::pi;
  check_chart(Torus{centre, 3 * axis, 1.1, 0.35}, axis, centre, 2 * kPiD * 0.35, random);
  check_chart(Sphere{centre, 1.25}, Vec3::UnitZ(), centre, kPiD * 1.25, random);
  check_chart(Cylinder{centre - axis, centre + 2 * axis, 0.8}, axis, centre, 3, random);
  check_chart(Cone{centre - axis, centre + 2 * axis, 0.5, 1.5}, axis, centre, std::sqrt(10.0), random);
}

// CLAIM      IU.4.2.1, a set of values in a look-up table: between them lies a bicubic that goes through them all, is any
//            quadratic exactly, with its slopes, and misses t³ by just h³ t(1 − t)(1 − 2t); clamped at the edges.
// ORACLE     closed form: the polynomials.
// TOLERANCE  40 u of the largest height, as documented; slopes times the places along the coordinate.
TEST(Bump, InterpolatesTablesAsItsKernelPromises) {
  proves({"IU.4.2.1"}, Oracle::closed_form, "quadratics, and the cubic's own remainder");
  TableRelief table;
  table.columns = 9;
  table.rows = 7;
  table.edges = TableEdges::clamped;
  const auto fill = [&](auto&& f) {
    table.heights.clear();
    for (int j = 0; j < table.rows; ++j) {
      for (int i = 0; i < table.columns; ++i) table.heights.push_back(f(1.0 * i, 1.0 * j));
    }
  };
  const auto quadratic = [](double x, double y) { return (3 - x + 0.5 * x * x) * (1 + 2 * y - 0.25 * y * y); };
  fill(quadratic);
  constexpr double kLargest = 27 * 5;
  constexpr double kTolerance = 40 * kUnitRoundoff * kLargest;
  for (double x = 1; x <= 7; x += 0.1875) {
    for (double y = 1; y <= 5; y += 0.1875) {
      const Relief at = relief(table, x / 8, y / 6);
      EXPECT_TRUE(near(at.height, quadratic(x, y), kTolerance));
      EXPECT_TRUE(near(at.along_u, 8 * (x - 1) * (1 + 2 * y - 0.25 * y * y), 8 * kTolerance));
      EXPECT_TRUE(near(at.along_v, 6 * (3 - x + 0.5 * x * x) * (2 - 0.5 * y), 6 * kTolerance));
    }
  }
  fill([](double x, double) { return x * x * x; });
  for (double t = 0; t < 1; t += 0.0625) {
    EXPECT_TRUE(near(relief(table, (3 + t) / 8, 0.4).height, std::pow(3 + t, 3) + t * (1 - t) * (1 - 2 * t),
                     40 * kUnitRoundoff * 512));
  }
  for (const double u : {-3.0, -1e-9, 1.5, 1e9}) {
    const Relief beyond = relief(table, u, 0.5);
    EXPECT_TRUE(near(beyond.height, u < 0 ? 0 : 512, u == -1e-9 ? 1e-7 : kTolerance));
    EXPECT_TRUE(u == -1e-9 || near(beyond.along_u, 0, kTolerance));
  }
  table.heights.pop_back();
  EXPECT_TRUE(refuses([&] { (void)relief(table, 0.5, 0.5); }));
}

// CLAIM      IU.4.2.1: the table of an analytic function stands for it: values converge with the third order, slopes with the second;
//            copies lie side by side without a step, also in the slope, and so do the two ends.
// ORACLE     closed form: the function, sin(2πu) cos(4πv) + ½ cos(2πu), and its derivatives.
// TOLERANCE  observed orders of 3 and 2 within 0.1 from 32 places on.
TEST(Bump, ConvergesFromTableToFunction) {
  proves({"IU.4.2.1"}, Oracle::closed_form, "a smooth periodic function");
  constexpr double kP = 2 * std::numbers::pi;
  std::array<double, 3> value{}, slopes{};
  for (std::size_t level = 0; level < 3; ++level) {
    TableRelief table;
    table.columns = table.rows = 32 << level;
    table.repeat_u = 3;
    for (int j = 0; j < table.rows; ++j) {
      for (int i = 0; i < table.columns; ++i) {
        const double u = 1.0 * i / table.columns, v = 1.0 * j / table.rows;
        table.heights.push_back(std::sin(kP * u) * std::cos(2 * kP * v) + 0.5 * std::cos(kP * u));
      }
    }
    uses_seed(34);
    CounterRandom random(34);
    for (int k = 0; k < 4000; ++k) {
      const double u = random.between(-1, 2), v = random.between(-1, 2), w = 3 * u;
      const Relief at = relief(table, u, v);
      const double f = std::sin(kP * w) * std::cos(2 * kP * v) + 0.5 * std::cos(kP * w);
      const double f_u = 3 * kP * (std::cos(kP * w) * std::cos(2 * kP * v) - 0.5 * std::sin(kP * w));
      const double f_v = -2 * kP * std::sin(kP * w) * std::sin(2 * kP * v);
      value[level] = std::max(value[level], std::abs(at.height - f));
      slopes[level] = std::max({slopes[level], std::abs(at.along_u - f_u), std::abs(at.along_v - f_v)});
    }
  }
  constexpr double kOrder = 0.1;
  for (std::size_t level = 1; level < 3; ++level) {
    EXPECT_TRUE(within(std::abs(std::log2(value[level - 1] / value[level]) - 3), kOrder));
    EXPECT_TRUE(within(std::abs(std::log2(slopes[level - 1] / slopes[level]) - 2), kOrder));
  }
}

// CLAIM      IU.4.2.1, a random part: heights are those of the counter that the seed starts, even in [−a, a), with mean 0 and
//            variance a²/3, and independent of their neighbours; other seeds have other ones.
// ORACLE     identity: SplitMix64 as the tests have it. Statistics, seed 5: Kolmogorov and Smirnov's distance, mean, variance, products
//            of neighbours along rows and columns, of 65,536 heights.
// TOLERANCE  identity: none. Each of five statistics within what it leaves with probability 10^-6: distance 2.69/√N, the others 4.9 σ.
TEST(Bump, DrawsRoughnessFromACounter) {
  proves({"IU.4.2.1"}, Oracle::identity, "SplitMix64, another implementation");
  constexpr int kSide = 256;
  constexpr double kAmplitude = 0.25, kCount = kSide * kSide;
  const TableRelief table = random_relief(kSide, kSide, kAmplitude, 5);
  CounterRandom counter(CounterRandom(5).next());
  std::uint64_t unlike = 0, same = 0;
  for (const double height : table.heights) unlike += height != kAmplitude * (2 * counter.unit() - 1) ? 1u : 0u;
  EXPECT_TRUE(all_agree(unlike, table.heights.size()));
  const TableRelief other = random_relief(kSide, kSide, kAmplitude, 6);
  for (std::size_t k = 0; k < table.heights.size(); ++k) same += table.heights[k] == other.heights[k] ? 1u : 0u;
  EXPECT_TRUE(all_agree(same, table.heights.size()));

  proves({"IU.4.2.1"}, Oracle::statistics, "five statistics of an even distribution");
  uses_seed(5);
  std::vector<double> sorted = table.heights;
  std::sort(sorted.begin(), sorted.end());
  double distance = 0, sum = 0, squares = 0, along = 0, down = 0;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const double even = (sorted[k] / kAmplitude + 1) / 2, place = static_cast<double>(k);
    distance = std::max({distance, even - place / kCount, (place + 1) / kCount - even});
    const double h = table.heights[k] / kAmplitude;
    sum += h;
    squares += h * h;
    along += h * table.heights[k % kSide + 1 == kSide ? k + 1 - kSide : k + 1] / kAmplitude;
    down += h * table.heights[(k + kSide) % sorted.size()] / kAmplitude;
  }
  constexpr double kSigmas = 4.9;  // 10^-6, both sides
  EXPECT_TRUE(within(distance, 2.69 / std::sqrt(kCount)));
  EXPECT_TRUE(near(sum / kCount, 0, kSigmas * std::sqrt(1 / (3 * kCount))));
  EXPECT_TRUE(near(squares / kCount, 1.0 / 3, kSigmas * std::sqrt(4.0 / 45 / kCount)));
  EXPECT_TRUE(near(along / kCount, 0, kSigmas / 3 / std::sqrt(kCount)));
  EXPECT_TRUE(near(down / kCount, 0, kSigmas / 3 / std::sqrt(kCount)));
}

// CLAIM      IU.4.2.1: coordinates laid in a plane, at an angle to each other, perturb a surface that stands across it as its
//            displacement would.
// ORACLE     closed form: the displaced polygon's tangents, by fourth-order differences.
// TOLERANCE  for a plane nothing of the first order is left out, 2Hf being zero: what the differences err by, h^4/30 of a (4π/size)^5: 1e-8.
TEST(Bump, LaysCoordinatesInAPlane) {
  proves({"IU.4.2.1"}, Oracle::closed_form, "tangents of a displaced plane");
  uses_seed(35);
  CounterRandom random(35);
  MaterialBump bump;
  MaterialBump::Lay lay;
  lay.origin = {0.2, 0.1, -0.4};
  lay.u = random_unit(random);
  lay.v = random_unit(random);
  lay.size = 0.7;
  bump.lay = lay;
  bump.relief = WaveRelief{0.05, 1, 2};
  const Vec3 normal = random_unit(random);
  const TangentFrame frame = tangent_frame(normal);
  const Shape shape = Plane{Vec3(1, 2, 3), normal};
  constexpr double kDifferences = 1e-8;
  for (int k = 0; k < 100; ++k) {
    const double a = random.between(-1, 1), b = random.between(-1, 1);
    const auto at = [&](Long s, Long t) -> Long3 {
      const Long3 p = Long3(1, 2, 3) + s * frame.u.cast<Long>() + t * frame.v.cast<Long>();
      const Long3 from = (p - lay.origin.cast<Long>()) / static_cast<Long>(0.7);
      const Long u = lay.u.cast<Long>().dot(from), v = lay.v.cast<Long>().dot(from);
      return p + static_cast<Long>(0.05) * std::cos(2 * kPi * u) * std::cos(4 * kPi * v) * normal.cast<Long>();
    };
    const Long3 along_s = slope([&](Long x) { return at(x, b); }, a),
                along_t = slope([&](Long x) { return at(a, x); }, b);
    const Vec3 point = Vec3(1, 2, 3) + a * frame.u + b * frame.v;
    const Vec3 found = shading_normal(bump, shape, point, normal);
    EXPECT_TRUE(within((found.cast<Long>() - along_s.cross(along_t).normalized()).cast<double>().norm(), kDifferences));
  }
}

// CLAIM      IU.4.2.1: what a bump mirrors never leads into the surface, and its direction does not jump where it just would.
// ORACLE     identity: D·n > 0 for the outcome; the outcome of directions that are mirror images in the surface is the same.
// TOLERANCE  none for the side; 42 u between the two, two mirrorings.
TEST(Bump, KeepsMirroredRaysOutside) {
  proves({"IU.4.2.1"}, Oracle::identity, "the surface's two sides");
  uses_seed(36);
  CounterRandom random(36);
  std::uint64_t inside = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 normal = random_unit(random), direction = random_unit(random);
    const Vec3 kept = kept_outside(direction, normal);
    inside += kept.dot(normal) >= 0 ? 0u : 1u;
    const Vec3 image = direction - 2 * direction.dot(normal) * normal;
    EXPECT_TRUE(within((kept_outside(image, normal) - kept).norm(), 42 * kUnitRoundoff));
  }
  EXPECT_TRUE(all_agree(inside, 1000));
}

// CLAIM      a random relief has a column and a row at least.
// ORACLE     identity: the domain as documented.
// TOLERANCE  none.
TEST(Bump, RefusesReliefsWithoutExtent) {
  proves({}, Oracle::identity, "reliefs outside the domain");
  EXPECT_TRUE(holds(random_relief(1, 1, 1, 7).rows == 1));
  EXPECT_TRUE(refuses([] { return random_relief(0, 1, 1, 7); }));
  EXPECT_TRUE(refuses([] { return random_relief(1, 0, 1, 7); }));
}

}  // namespace
}  // namespace etendue::validation
