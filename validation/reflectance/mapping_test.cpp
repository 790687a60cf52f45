// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/mapping.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "etendue/geometry/meeting.hpp"
#include "etendue/reflectance/surface_parameters.hpp"
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

// CLAIM      IU.4-1: a box shows the pattern once on each face, upright and not mirrored as seen from outside; the places are those that points on the
//            faces were made from, edges and corners included.
// ORACLE     identity: the forward map of each face, written out; right × up points out of the box.
// TOLERANCE  64 u.
TEST(PatternMapping, ShowsThePatternOnEachFaceOfABox) {
  proves({"IU.4-1"}, Oracle::identity, "forward maps of six faces on 9 x 9 points, ten frames");
  Directions random(2604);
  for (int turn = 0; turn < 10; ++turn) {
    const PatternFrame frame = turn == 0 ? PatternFrame{} : random_frame(random);
    const Vec3 x = frame.equator, y = frame.pole.cross(frame.equator), z = frame.pole, edges(0.5, 2, 3);
    struct Face {
      Vec3 out, right, up;
      double depth, width, height;
    };
    const Face faces[] = {{x, y, z, 0.5, 2, 3},  {-x, -y, z, 0.5, 2, 3}, {y, -x, z, 2, 0.5, 3},
                          {-y, x, z, 2, 0.5, 3}, {z, x, y, 3, 0.5, 2},   {-z, -x, y, 3, 0.5, 2}};
    for (const Face& face : faces) {
      EXPECT_TRUE(near((face.right.cross(face.up) - face.out).norm(), 0, 4 * kUnitRoundoff));
      for (int i = 1; i < 8; ++i) {
        for (int j = 1; j < 8; ++j) {
          const double u = i / 8.0, v = j / 8.0;
          const Vec3 point =
              face.depth / 2 * face.out + (u - 0.5) * face.width * face.right + (v - 0.5) * face.height * face.up;
          const CubePoint at = box_mapping(frame, point, edges);
          EXPECT_TRUE(near(at.at.u, u, 64 * kUnitRoundoff));
          EXPECT_TRUE(near(at.at.v, v, 64 * kUnitRoundoff));
        }
      }
    }
  }
  const CubePoint corner = box_mapping({}, {1, 1, 1}, {2, 2, 2});
  EXPECT_TRUE(holds(corner.face == CubeFace::right && corner.at.u == 1 && corner.at.v == 1));
  EXPECT_TRUE(refuses([] { return box_mapping({}, {0, 0, 0}, {1, 1, 1}); }));
  EXPECT_TRUE(refuses([] { return box_mapping({}, {1, 0, 0}, {1, 0, 1}); }));
}

/// Around a circle: 0.999 and 0.001 are near.
double turned(double from, double to) {
  const double away = to - from;
  return away - std::round(away);
}

// CLAIM      IU.4-1: each mapping says by how much u and v change with the point; where it has no value, on axes and in middles, it still says a place.
// ORACLE     closed form: differences of the mapping itself over 2^-16 of the distance, to second order.
// TOLERANCE  the third derivatives of angles over a cube's distance: 16 (2^-16)² of the slope, and the rounding of places, 2^-48, over the step.
TEST(PatternMapping, KnowsItsSlopes) {
  proves({"IU.4-1"}, Oracle::metamorphic, "central differences, 4 x 500 points");
  Directions random(2605);
  for (int i = 0; i < 500; ++i) {
    const PatternFrame frame = random_frame(random);
    const Vec3 middle(random.uniform(-1, 1), 0.5, -2), edges(0.7, 1.1, 1.3);
    for (const LaidPattern& laid :
         {LaidPattern(LaidOnPlane{middle, frame, 0.3, 0.8}), LaidPattern(LaidOnCylinder{middle, frame, 2}),
          LaidPattern(LaidOnSphere{middle, frame}), LaidPattern(LaidOnBox{middle, frame, edges})}) {
      Vec3 from = random.unit();
      if (frame.pole.cross(from).norm() < 0.25) from += 2 * frame.equator;
      const double distance = random.uniform(0.5, 2);
      const Vec3 point = middle + distance * from;
      const PatternPlace place = place_in(laid, point);
      const double step = 0x1p-16 * distance;
      const Vec3 way = step * random.unit();
      const PatternPoint before = place_in(laid, point - way).at, after = place_in(laid, point + way).at;
      if (std::holds_alternative<LaidOnBox>(laid) && std::abs(after.u - before.u) > 0.01) continue;  // over an edge
      const double tolerance = 0x1p-28 * 64 * step + 0x1p-46;
      EXPECT_TRUE(within(std::abs(turned(before.u, after.u) / 2 - place.u_slope.dot(way)), tolerance)) << laid.index();
      EXPECT_TRUE(within(std::abs((after.v - before.v) / 2 - place.v_slope.dot(way)), tolerance)) << laid.index();
    }
  }
  for (const Vec3& on_axis : {Vec3(0, 0, 0), Vec3(0, 0, 2), Vec3(0, 0, -3)}) {
    for (const LaidPattern& laid :
         {LaidPattern(LaidOnCylinder{}), LaidPattern(LaidOnSphere{}), LaidPattern(LaidOnBox{})}) {
      const PatternPlace place = place_in(laid, on_axis);
      EXPECT_TRUE(holds(std::isfinite(place.at.u) && std::isfinite(place.at.v) && place.u_slope.allFinite() &&
                        place.v_slope.allFinite()));
    }
  }
}

/// A surface by its parameters, shares of turns and heights, in long double where it matters: and as the shape that rays meet.
struct Parametric {
  std::string name;
  std::function<Vec3(double, double)> at;
  std::function<PatternPlace(const Ray&)> met;  // places of the shape's hits
  bool u_turns, v_turns;
};

template <class Shape>
std::function<PatternPlace(const Ray&)> places_on(const Shape& shape) {
  return [shape](const Ray& ray) { return parameters(shape, intersect(ray, shape).value()); };
}

std::vector<Parametric> parametric_surfaces() {
  std::vector<Parametric> all;
  const auto around = [](const Vec3& axis, double u) -> Vec3 {
    const TangentFrame frame = tangent_frame(axis);
    return std::cos(2 * std::numbers::pi * u) * frame.u + std::sin(2 * std::numbers::pi * u) * frame.v;
  };
  const Vec3 centre(1, -2, 0.5), axis = Vec3(1, 2, 2) / 3;
  all.push_back({"sphere",
                 [=](double u, double v) -> Vec3 {
                   return centre + 1.5 * sphere_normal({}, {u, v});
                 },
                 places_on(Sphere{centre, 1.5}), true, false});
  all.push_back({"cylinder", [=](double u, double v) -> Vec3 { return centre + 2 * v * axis + 0.5 * around(axis, u); },
                 places_on(Cylinder{centre, centre + 2 * axis, 0.5}), true, false});
  all.push_back({"cone",
                 [=](double u, double v) -> Vec3 { return centre + 2 * v * axis + (1 - 0.75 * v) * around(axis, u); },
                 places_on(Cone{centre, centre + 2 * axis, 1, 0.25}), true, false});
  all.push_back({"torus",
                 [=](double u, double v) -> Vec3 {
                   const double tube = 2 * std::numbers::pi * v;
                   return centre + (2 + 0.5 * std::cos(tube)) * around(axis, u) + 0.5 * std::sin(tube) * axis;
                 },
                 places_on(Torus{centre, axis, 2, 0.5}), true, true});
  all.push_back({"disc",
                 [=](double u, double v) -> Vec3 {
                   const TangentFrame frame = tangent_frame(axis);
                   return centre + 2 * ((2 * u - 1) * frame.u + (2 * v - 1) * frame.v);
                 },
                 places_on(Disc{centre, axis, 2}), false, false});
  const Vec3 p(0, 0, 0), q(2, 1, 0), r(0.5, 2, 1);
  all.push_back({"parallelogram", [=](double u, double v) -> Vec3 { return p + u * (q - p) + v * (r - p); },
                 places_on(Polygon::make({p, q, q + r, r}).value()), false, false});
  BezierSurface surface;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      surface.control[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = {i + 0.2 * j, j - 0.1 * i * i,
                                                                                   0.3 * i * (3 - i) * (j - 1)};
  }
  const auto bernstein = [](int i, double t) {
    constexpr double kBinomial[] = {1, 3, 3, 1};
    return kBinomial[i] * std::pow(t, i) * std::pow(1 - t, 3 - i);
  };
  all.push_back({"Bezier surface",
                 [=](double u, double v) -> Vec3 {
                   Vec3 sum = Vec3::Zero();
                   for (int i = 0; i < 4; ++i) {
                     for (int j = 0; j < 4; ++j)
                       sum += bernstein(i, u) * bernstein(j, v) *
                              surface.control[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
                   }
                   return sum;
                 },
                 places_on(surface), false, false});
  // A mesh with coordinates of its own: u, v of a skewed map, (0.1, 0.2) + 0.5 s (1, 0.5) + 0.5 t (−0.25, 1).
  Mesh mesh{{p, q, q + r, r}, {{0, 1, 2}, {0, 2, 3}}, {{0.1, 0.2}, {0.6, 0.45}, {0.475, 0.95}, {-0.025, 0.7}}};
  const auto on_mesh = [=](double u, double v) -> Vec3 {
    // The inverse of that map, by Cramer's rule: determinant of ((0.5, −0.125), (0.25, 0.5)).
    const double a = u - 0.1, b = v - 0.2, size = 0.25 + 0.03125;
    const double s = (0.5 * a + 0.125 * b) / size, t = (0.5 * b - 0.25 * a) / size;
    return p + s * (q - p) + t * (r - p);
  };
  all.push_back({"mesh", on_mesh,
                 [mesh](const Ray& ray) {
                   for (std::size_t part = 0; part < 2; ++part) {
                     if (const auto hit = intersect(ray, mesh.triangle(part))) return parameters(mesh, *hit, part);
                   }
                   throw std::runtime_error("the mesh was missed");
                 },
                 false, false});
  return all;
}

// CLAIM      IU.4.1.2: a ray that meets a sphere, cylinder, cone, torus, disc, polygon, Bézier surface or mesh where it was made from (u, v) finds these in the
//            pattern, on a dense grid beside seams and poles; and the slopes are those of the surface: P_u·∇u = 1, P_v·∇u = 0 and so on.
// ORACLE     identity: the forward map of each surface, written out, and its differences.
// TOLERANCE  places: 2^-40 (rays of length 1 from points a few units away, hits within 2^-44 of their size, and a hundredth of a turn's radius at
//            least). Slopes: second differences over 2^-14 of smooth maps, 2^-18.
TEST(PatternMapping, FollowsTheParametersOfSurfaces) {
  proves({"IU.4.1.2"}, Oracle::identity, "eight forward maps on 29 x 29 points and beside their edges");
  std::vector<double> grid{1e-3, 1 - 1e-3};
  for (int i = 1; i < 28; ++i) grid.push_back(i / 28.0);
  for (const Parametric& surface : parametric_surfaces()) {
    for (const double s : grid) {
      for (const double t : grid) {
        // Of the mesh the middle; a disc ends on its circle.
        const bool is_mesh = surface.name == "mesh", is_disc = surface.name == "disc";
        const double u = is_mesh ? 0.15 + 0.25 * s : is_disc ? 0.5 + 0.7 * (s - 0.5) : s;
        const double v = is_mesh ? 0.4 + 0.25 * t : is_disc ? 0.5 + 0.7 * (t - 0.5) : t;
        const Vec3 point = surface.at(u, v);
        constexpr double kStep = 0x1p-14;
        const Vec3 along_u = (surface.at(u + kStep, v) - surface.at(u - kStep, v)) / (2 * kStep);
        const Vec3 along_v = (surface.at(u, v + kStep) - surface.at(u, v - kStep)) / (2 * kStep);
        const Vec3 normal = along_u.cross(along_v).normalized();
        Ray ray;
        ray.origin = point + 0.125 * normal;
        ray.direction = -normal;
        const PatternPlace place = surface.met(ray);
        const double off_u = surface.u_turns ? turned(place.at.u, u) : place.at.u - u;
        const double off_v = surface.v_turns ? turned(place.at.v, v) : place.at.v - v;
        EXPECT_TRUE(within(std::abs(off_u), 0x1p-40)) << surface.name << ' ' << u << ' ' << v;
        EXPECT_TRUE(within(std::abs(off_v), 0x1p-40)) << surface.name << ' ' << u << ' ' << v;
        EXPECT_TRUE(near(place.u_slope.dot(along_u), 1, 0x1p-18)) << surface.name << ' ' << u << ' ' << v;
        EXPECT_TRUE(near(place.v_slope.dot(along_v), 1, 0x1p-18)) << surface.name;
        EXPECT_TRUE(near(place.u_slope.dot(along_v), 0, 0x1p-18 * place.u_slope.norm() * along_v.norm()))
            << surface.name;
        EXPECT_TRUE(near(place.v_slope.dot(along_u), 0, 0x1p-18 * place.v_slope.norm() * along_u.norm()))
            << surface.name;
      }
    }
  }
}

}  // namespace
}  // namespace etendue::validation
