// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/point_polygon.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "etendue/form_factor/obstructed.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/element_rectangle.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Vec3 tilted_direction(const Vec3& d) {
  return (tilted(d) - tilted(Vec3::Zero())).normalized();
}

// CLAIM      IU.6-2: Lambert's sum gives the factor from an element to a parallel rectangle under its corner.
// ORACLE     closed form: the corner formula in balls of 600 bits.
// TOLERANCE  the returned bound, the frame's rounding being carried by the coordinates: kFrame of one, as the polygon's
//            vertices and the element move by some units in the last place of coordinates near one.
TEST(PointToPolygon, MeetsTheCornerFormula) {
  proves({"IU.6-2"}, Oracle::closed_form, "element above a rectangle's corner, 600-bit balls");
  constexpr double kFrame = 32 * 0x1p-53;
  for (double a : {0.01, 0.1, 1.0, 3.0, 50.0}) {
    for (double b : {0.02, 0.5, 1.0, 20.0}) {
      const Polygon seen = tilted(rectangle({0, 0, 1}, {0, b, 0}, {a, 0, 0}));
      const Bounded f = point_to_polygon(tilted(Vec3(0, 0, 0)), tilted_direction({0, 0, 1}), seen);
      EXPECT_TRUE(near(f.value, oracle::element_to_corner_rectangle(a, b), f.bound + kFrame * std::hypot(1, a, b)));
    }
  }
}

// CLAIM      IU.6-2: for a small polygon F tends to cos φ_i cos φ_j dA/(π R²), with an error of second order in its
//            size.
// ORACLE     closed form: the formula itself.
// TOLERANCE  (size/R)² of the value: half the Laplacian of the kernel is below 12 kernel/R², a square of side s has
//            second moments s²/12; and the returned bound.
TEST(PointToPolygon, TendsToTheDifferentialFactor) {
  proves({"IU.6-2"}, Oracle::closed_form, "cos cos dA/(pi R^2) at sizes 0.1 to 1e-3");
  const Vec3 centre(0.6, -0.3, 1.2);
  const Vec3 normal = Vec3(-0.2, 0.3, -1).normalized();
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  for (double s : {0.1, 0.03, 0.01, 0.003, 0.001}) {
    const Polygon small = rectangle(centre - 0.5 * s * (u + v), s * u, s * v);
    const double square = centre.squaredNorm();
    const double expected = centre.z() * -centre.dot(normal) / square * s * s / (std::numbers::pi * square);
    const Bounded f = point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), small);
    EXPECT_TRUE(near(f.value, expected, s * s / square * expected + f.bound)) << s;
  }
}

// CLAIM      G12: cosines are clamped at 0: backs see nothing, what lies below the horizon adds nothing.
// ORACLE     identity: the same polygon cut at the horizon by hand, and zeros.
// TOLERANCE  the returned bounds; the zeros are exact.
TEST(PointToPolygon, ClampsBothCosines) {
  proves({"G12", "IU.6-2"}, Oracle::identity, "cut by hand; without the clamp the horizon's lower half would subtract");
  const Vec3 up = Vec3::UnitZ();
  const Polygon wall = rectangle({1, -1, -1}, {0, 0, 2}, {0, 2, 0});  // faces the element, half below its horizon
  const Polygon upper_half = rectangle({1, -1, 0}, {0, 0, 1}, {0, 2, 0});
  const Bounded f = point_to_polygon(Vec3::Zero(), up, wall), half = point_to_polygon(Vec3::Zero(), up, upper_half);
  ASSERT_GT(half.value, 0.1);
  EXPECT_TRUE(near(f.value, half.value, f.bound + half.bound));
  // Unclamped, the lower half cancels the upper one by symmetry.
  std::vector<Vec3> seen(wall.vertices());
  EXPECT_TRUE(near(lambert_sum(seen, up).value, 0, lambert_sum(seen, up).bound));
  EXPECT_TRUE(within(point_to_polygon({2, 0, 0}, up, wall).value, 0)) << "behind the polygon";
  EXPECT_TRUE(within(point_to_polygon({1, 0, 0}, up, wall).value, 0)) << "in the polygon's plane";
  EXPECT_TRUE(within(point_to_polygon({0, 0, 5}, up, wall).value, 0)) << "above all of it";
  EXPECT_THROW(static_cast<void>(point_to_polygon(Vec3::Zero(), 2 * up, wall)), ContractViolation);
}

// CLAIM      G12: an element a hair in front of a polygon sees it, one a hair behind does not.
// ORACLE     identity: F = 1 at a distance far below the polygon's size, and 0 behind.
// TOLERANCE  the returned bound, and 4 distance/side for the open rim; zero behind.
TEST(PointToPolygon, TellsFrontFromBehindAtAnyDistance) {
  proves({"G12", "IU.6-2"}, Oracle::identity, "an element 1e-12 to 1e-30 above and below a unit square");
  constexpr double kUseful = 1e-12;
  const Polygon square = rectangle({-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0});
  for (double z : {1e-12, 1e-15, 1e-17, 1e-30}) {
    const Bounded f = point_to_polygon({0, 0, z}, -Vec3::UnitZ(), square);
    EXPECT_TRUE(near(f.value, 1, f.bound + 4 * z)) << z;
    EXPECT_TRUE(within(f.bound, kUseful)) << z;
    const Bounded behind = point_to_polygon({0, 0, -z}, -Vec3::UnitZ(), square);
    EXPECT_TRUE(within(behind.value + behind.bound, 0)) << z;
  }
}

// CLAIM      IU.6-2: a normal that is off length one as far as is accepted does not move the factor out of its bound.
// ORACLE     identity: F is a matter of the direction only.
// TOLERANCE  4 u: the division by the length, and the two sums near one.
TEST(PointToPolygon, DividesByTheLengthOfTheNormal) {
  proves({"IU.6-2"}, Oracle::identity, "normals 15 u too long and too short");
  const Polygon square = rectangle({-8, -8, 0.5}, {0, 16, 0}, {16, 0, 0});
  const Bounded exact = point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), square);
  for (double off : {-14.0, 14.0}) {
    const Bounded f = point_to_polygon(Vec3::Zero(), (1 + off * 0x1p-53) * Vec3::UnitZ(), square);
    EXPECT_TRUE(near(f.value, exact.value, 4 * 0x1p-53)) << off;
  }
}

// CLAIM      G12: an element that is nowhere has no factor.
// ORACLE     identity: the documented contract.
// TOLERANCE  none: each call is refused or not.
TEST(PointToPolygon, RefusesPointsThatAreNotFinite) {
  proves({"G12"}, Oracle::identity, "NaN and infinity in either routine");
  const Polygon square = rectangle({-0.5, -0.5, 1}, {0, 1, 0}, {1, 0, 0});
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(refuses([&] { static_cast<void>(point_to_polygon({0, bad, 0}, Vec3::UnitZ(), square)); }));
    EXPECT_TRUE(refuses([&] {
      static_cast<void>(visible_point_to_polygon({0, bad, 0}, Vec3::UnitZ(), square, std::span<const Polygon>{}));
    }));
  }
}

// CLAIM      IU.6-2: the factor knows no unit of length: scaled by a power of two it has the same bits.
// ORACLE     metamorphic: powers of two up to 2^±190: coordinates end at 2^200.
// TOLERANCE  none.
TEST(PointToPolygon, KnowsNoUnit) {
  proves({"IU.6-2"}, Oracle::metamorphic, "points and polygons times powers of two");
  const std::vector<Vec3> corners{{-0.5, -0.3, 1}, {-0.4, 0.9, 1.1}, {0.7, 0.8, 1.3}};
  const Vec3 point(0.1, -0.2, 0.05), normal = Vec3(0.2, 0.1, 1).normalized();
  const Bounded plain = point_to_polygon(point, normal, polygon(corners));
  ASSERT_GT(plain.value, 0.01);
  for (const int power : {-190, -60, 60, 190}) {
    std::vector<Vec3> scaled;
    for (const Vec3& v : corners) scaled.push_back(std::ldexp(1.0, power) * v);
    const Bounded found = point_to_polygon(std::ldexp(1.0, power) * point, normal, polygon(scaled));
    EXPECT_TRUE(holds(found.value == plain.value && found.bound == plain.bound)) << power;
  }
}

// CLAIM      G12: a unit normal is one but for the roundings of its making, past blockers, too.
// ORACLE     identity: normalized vectors whose squares are not 1.
// TOLERANCE  none.
TEST(PointToPolygon, AcceptsNormalizedNormals) {
  proves({"G12"}, Oracle::identity, "normalized vectors, past a blocker");
  const Polygon seen = rectangle({-0.5, -0.5, 1}, {0, 1, 0}, {1, 0, 0});
  const std::vector<Polygon> blockers{rectangle({0, 0, 0.5}, {0.2, 0, 0}, {0, 0.2, 0})};
  int inexact = 0;
  for (int i = 1; i < 60; ++i) {
    const Vec3 normal = Vec3(0.01 * i, 0.3 - 0.007 * i, 1).normalized();
    inexact += normal.squaredNorm() != 1;
    EXPECT_TRUE(holds(visible_point_to_polygon(Vec3::Zero(), normal, seen, blockers).value > 0.05));
  }
  EXPECT_GT(inexact, 5);
  EXPECT_TRUE(refuses([&] { return visible_point_to_polygon(Vec3::Zero(), Vec3(0, 0, 1.001), seen, blockers); }));
}

}  // namespace
}  // namespace etendue::validation
