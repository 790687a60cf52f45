// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/mapping.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "optics/incidence.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Wide = long double;
constexpr Wide kPi = std::numbers::pi_v<long double>;

PatternFrame random_frame(Directions& random) {
  const Vec3 pole = random.unit();
  return {pole, random.orthogonal_to(pole)};
}

// CLAIM      E29: what 4-3 calls latitude is the angle from the south pole: 0 there, a right angle on the equator, π at the north pole, whose
//            latitude is half of that and whose v would then be ½. docs/notation.md has one name for each of these.
// ORACLE     closed form: the three points.
// TOLERANCE  kMappingError.
TEST(SphereMapping, CountsFromTheSouthPole) {
  proves({"E29", "IU.4-2", "IU.4-3"}, Oracle::closed_form, "poles and equator");
  const PatternFrame frame;
  EXPECT_TRUE(near(sphere_mapping(frame, -frame.pole).v, 0, kMappingError));
  EXPECT_TRUE(near(sphere_mapping(frame, frame.equator).v, 0.5, kMappingError));
  EXPECT_TRUE(near(sphere_mapping(frame, frame.pole).v, 1, kMappingError));
  const double latitude = std::numbers::pi / 2;
  EXPECT_TRUE(apart(latitude / std::numbers::pi, sphere_mapping(frame, frame.pole).v, 0.4));
}

// CLAIM      IU.4-1, IU.4-2, IU.4-3, IU.4-4, IU.4-5: u and v of a normal on a sphere are those that the normal was made from, on a dense grid
//            with the seam and the poles, in any frame; u is 0 at the poles and at T_e, v runs from the south to the north pole.
// ORACLE     identity: the forward map in long double.
// TOLERANCE  kMappingError, and the 4 u that the normal and the frame are rounded by, over sin φ for u and counted around the circle.
TEST(SphereMapping, IsTheInverseOfLongitudeAndLatitude) {
  proves({"IU.4-1", "IU.4-2", "IU.4-3", "IU.4-4", "IU.4-5"}, Oracle::identity,
         "forward map on 41 × 80 points, ten frames");
  Directions random(2601);
  constexpr int kRows = 40, kColumns = 80;
  constexpr double tolerance = kMappingError + 4 * kUnitRoundoff;
  for (int turn = 0; turn < 10; ++turn) {
    const PatternFrame frame = turn == 0 ? PatternFrame{} : random_frame(random);
    const Vec3 third = frame.pole.cross(frame.equator);
    for (int row = 0; row <= kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const Wide u = static_cast<Wide>(column) / kColumns, v = static_cast<Wide>(row) / kRows;
        const Wide sine = std::sin(kPi * v), c = -std::cos(kPi * v), x = sine * std::cos(2 * kPi * u),
                   y = sine * std::sin(2 * kPi * u);
        Vec3 normal;
        for (int k = 0; k < 3; ++k)
          normal[k] = static_cast<double>(c * frame.pole[k] + x * frame.equator[k] + y * third[k]);
        const PatternPoint at = sphere_mapping(frame, normal);
        EXPECT_TRUE(holds(0 <= at.u && at.u < 1 && 0 <= at.v && at.v <= 1));
        EXPECT_TRUE(near(at.v, static_cast<double>(v), tolerance));
        if (row == 0 || row == kRows) continue;
        const double away = std::abs(at.u - static_cast<double>(u));
        EXPECT_TRUE(within(std::min(away, 1 - away), tolerance / static_cast<double>(sine))) << row << ' ' << column;
        EXPECT_TRUE(within((sphere_normal(frame, at) - normal).norm(), 32 * kUnitRoundoff));
      }
    }
  }
  const PatternFrame frame;
  EXPECT_TRUE(holds(sphere_mapping(frame, Vec3::UnitZ()).u == 0 && sphere_mapping(frame, Vec3::UnitZ()).v == 1));
  EXPECT_TRUE(holds(sphere_mapping(frame, -Vec3::UnitZ()).u == 0 && sphere_mapping(frame, -Vec3::UnitZ()).v == 0));
  EXPECT_TRUE(holds(sphere_mapping(frame, Vec3::UnitX()).u == 0 && sphere_mapping(frame, Vec3::UnitX()).v == 0.5));
}

/// As printed in 4-4 and 4-5.
double printed_u(const Vec3& normal) {
  const double latitude = std::acos(-normal.z()),
               u = std::acos(normal.x() / std::sin(latitude)) / (2 * std::numbers::pi);
  return normal.y() < 0 ? u - 1 : u;
}

// CLAIM      E1: for N = −y the printed rule gives u = −0.75; the point lies three quarters around the equator. Taken modulo one, 0.25, it
//            mirrors the pattern.
// ORACLE     closed form: longitude 270°.
// TOLERANCE  4 u for the printed form, none for the mended one.
TEST(SphereMapping, GoesOnBehindTheMeridian) {
  proves({"E1", "IU.4-5"}, Oracle::closed_form, "longitude 270 degrees is u = 3/4");
  const Vec3 normal(0, -1, 0);
  EXPECT_TRUE(near(printed_u(normal), -0.75, 4 * kUnitRoundoff));
  EXPECT_TRUE(near(sphere_mapping({}, normal).u, 0.75, 0));
}

// CLAIM      G5: on the meridian u = 0 rounding takes the printed arc cosine's argument beyond one in a part of the points: no number comes
//            out. The mended form gives 0 in all.
// ORACLE     closed form: u = 0.
// TOLERANCE  kMappingError and 4 u over sin φ; of the printed form at least one point in twenty fails.
TEST(SphereMapping, HasNumbersOnTheFirstMeridian) {
  proves({"G5", "IU.4-4"}, Oracle::closed_form, "u = 0 on 10,000 points of the meridian");
  int lost = 0;
  constexpr int kPoints = 10000;
  for (int i = 1; i < kPoints; ++i) {
    const double latitude = std::numbers::pi * i / kPoints;
    const Vec3 normal(std::sin(latitude), 0, -std::cos(latitude));
    lost += std::isnan(printed_u(normal));
    const double u = sphere_mapping({}, normal).u;
    EXPECT_TRUE(within(std::min(u, 1 - u), (kMappingError + 4 * kUnitRoundoff) / normal.x()));
  }
  EXPECT_GT(lost, kPoints / 20);
}

// CLAIM      IU.4-1: a cylinder's and a plane's places are those that a point was made from.
// ORACLE     identity: the forward maps.
// TOLERANCE  16 u of the greatest number that enters.
TEST(PatternMapping, KnowsCylindersAndPlanes) {
  proves({"IU.4-1"}, Oracle::identity, "forward maps, 2,000 points in random frames");
  Directions random(2602);
  for (int i = 0; i < 2000; ++i) {
    const PatternFrame frame = random_frame(random);
    const Vec3 third = frame.pole.cross(frame.equator);
    const double u = random.uniform(0.001, 0.999), v = random.uniform(-1, 2), radius = random.uniform(0.5, 3),
                 size = random.uniform(0.5, 4);
    const double turn = 2 * std::numbers::pi * u;
    const Vec3 wall = radius * (std::cos(turn) * frame.equator + std::sin(turn) * third) + v * size * frame.pole;
    const PatternPoint round = cylinder_mapping(frame, wall, size);
    EXPECT_TRUE(near(round.u, u, 64 * kUnitRoundoff));
    EXPECT_TRUE(near(round.v, v, 256 * kUnitRoundoff));
    const Vec3 floor = size * (u * frame.equator + v * third) + radius * frame.pole;
    const PatternPoint flat = plane_mapping(frame, floor, size);
    EXPECT_TRUE(near(flat.u, u, 256 * kUnitRoundoff));
    EXPECT_TRUE(near(flat.v, v, 256 * kUnitRoundoff));
  }
  EXPECT_TRUE(all_agree(accepted([] {
                          return sphere_mapping({}, {0, 0, 2});
                        }) + accepted([] {
                          return sphere_mapping({{0, 0, 1}, {0, 0, 1}}, {0, 0, 1});
                        }) + accepted([] {
                          return cylinder_mapping({}, {0, 0, 2}, 1);
                        }) + accepted([] {
                          return cylinder_mapping({}, {1, 0, 2}, 0);
                        }) + accepted([] {
                          return plane_mapping({}, {1, 0, 2}, -1);
                        }) + accepted([] {
                          return cube_mapping({0, 0, 0});
                        }),
                        6));
}

// CLAIM      IU.4.1.3: a direction leads to the image of the largest component and to where a camera with 90° both ways sees it; directions
//            towards the cube's edges and corners lie on the images' rims, at the same direction from either side.
// ORACLE     closed form: the camera's own projection; the images' cameras are right-handed, and their six pictures close.
// TOLERANCE  2 u for u and v; for the way back 4 u of a direction with largest component one.
TEST(CubeMapping, LeadsToTheImageThatShowsTheDirection) {
  proves({"IU.4.1.3"}, Oracle::closed_form, "26 directions to faces, edges and corners, and 10,000 random ones");
  for (const CubeFace face : kCubeFaces) {
    const CubeView view = cube_view(face);
    EXPECT_TRUE(near((view.right.cross(view.up) + view.gaze).norm(), 0, 0));  // right × up points back at the viewer
    const CubePoint middle = cube_mapping(view.gaze);
    EXPECT_TRUE(holds(middle.face == face && middle.at.u == 0.5 && middle.at.v == 0.5));
  }
  int rims = 0;
  for (int code = 0; code < 27; ++code) {
    const Vec3 direction(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    if (direction.isZero(0)) continue;
    const CubePoint at = cube_mapping(direction);
    EXPECT_TRUE(near((cube_direction(at) - direction).norm(), 0, 0));
    rims += at.at.u == 0 || at.at.u == 1 || at.at.v == 0 || at.at.v == 1;
    // Every face whose component is as large shows the same direction at its own rim.
    for (const CubeFace face : kCubeFaces) {
      const CubeView view = cube_view(face);
      if (direction.dot(view.gaze) != 1) continue;
      const PatternPoint there{0.5 * (1 + direction.dot(view.right)), 0.5 * (1 + direction.dot(view.up))};
      EXPECT_TRUE(near((cube_direction({face, there}) - direction).norm(), 0, 0));
    }
  }
  EXPECT_EQ(rims, 20);
  Directions random(2603);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 direction = random.uniform(0.1, 10) * random.unit();
    const CubePoint at = cube_mapping(direction);
    const CubeView view = cube_view(at.face);
    const double depth = direction.dot(view.gaze);
    EXPECT_TRUE(holds(depth == direction.cwiseAbs().maxCoeff()));
    EXPECT_TRUE(near(at.at.u, static_cast<double>((1 + static_cast<Wide>(direction.dot(view.right)) / depth) / 2),
                     2 * kUnitRoundoff));
    EXPECT_TRUE(near(at.at.v, static_cast<double>((1 + static_cast<Wide>(direction.dot(view.up)) / depth) / 2),
                     2 * kUnitRoundoff));
    EXPECT_TRUE(within((cube_direction(at) - direction / depth).norm(), 8 * kUnitRoundoff));
  }
}

}  // namespace
}  // namespace etendue::validation
