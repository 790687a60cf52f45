// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/camera_rays.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "etendue/core/rounding.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// Gaze and up are kept this far from parallel below; the normalised cross product then errs by 3 u / sin, 30 u.
constexpr double kLeastSine = 0.1;
/// Three frame vectors (30 u each where G × U shrinks by kLeastSine, twice that for Y, which is made of X), their
/// weights, two sums and the normalisation: 3 · 60 + 20 roundings, over |P| ≥ 1.
constexpr double kDirectionError = 200 * kUnitRoundoff;
/// Both forms start from the same frame: weights (5 roundings each), two sums, the normalisation (7).
constexpr double kSameRayError = 20 * kUnitRoundoff;

Camera random_camera(std::mt19937_64& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::uniform_real_distribution<double> angle(5 * kDegree, 70 * kDegree);
  std::uniform_int_distribution<int> size(1, 40);
  Camera camera;
  const auto vector = [&] {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return Vec3(x, y, z);
  };
  do {
    camera.eye = 100 * vector();
    camera.gaze = vector();
    camera.up = vector();
  } while (camera.gaze.normalized().cross(camera.up.normalized()).norm() < kLeastSine);
  camera.horizontal_half_angle = angle(random);
  camera.columns = size(random);
  camera.rows = size(random);
  return camera;
}

using Long3 = std::array<long double, 3>;
Long3 to_long(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
Long3 cross(const Long3& a, const Long3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Long3 unit(const Long3& a) {
  const long double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// The printed formulas of 5.2 in long double, with the view plane at distance d and j counted from the bottom.
Long3 printed_direction(const Camera& camera, int i, int j, long double d) {
  const Long3 g = unit(to_long(camera.gaze));
  const Long3 x = unit(cross(g, to_long(camera.up)));
  const Long3 y = unit(cross(x, g));
  const long double tan_theta = std::tan(static_cast<long double>(camera.horizontal_half_angle));
  const long double tan_phi = tan_theta * camera.rows / camera.columns;
  const long double across = 2 * ((i + 0.5L) / camera.columns) - 1;
  const long double up = 2 * ((j + 0.5L) / camera.rows) - 1;
  Long3 p{};
  for (std::size_t k = 0; k < 3; ++k) p[k] = d * g[k] + across * d * tan_theta * x[k] + up * d * tan_phi * y[k];
  return unit(p);
}

// CLAIM      IU.5.2: the primary ray of pixel (i, j) starts at E along P = dG + (2x' − 1)H + (2y' − 1)V, whatever d is;
//            our rows count from the top, the formula's j from the bottom.
// ORACLE     closed form: the printed formulas in long double, random cameras, d = 1 and d = 37.
// TOLERANCE  kDirectionError, derived above.
TEST(CameraRays, AreThoseOfTheViewingSystem) {
  proves({"IU.5.2"}, Oracle::closed_form, "the printed formulas in long double, over random cameras");
  std::mt19937_64 random(52);
  for (int trial = 0; trial < 200; ++trial) {
    const Camera camera = random_camera(random);
    const CameraFrame frame = camera_frame(camera).value();
    for (int row = 0; row < camera.rows; ++row) {
      for (int i = 0; i < camera.columns; ++i) {
        const Ray ray = eye_ray(frame, picture_point(camera, i, row));
        const Long3 expected = printed_direction(camera, i, camera.rows - 1 - row, trial % 2 == 0 ? 1 : 37);
        long double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const long double difference = ray.direction[static_cast<Eigen::Index>(k)] - expected[k];
          square += difference * difference;
        }
        ASSERT_TRUE(within(static_cast<double>(std::sqrt(square)), kDirectionError));
        ASSERT_EQ(ray.origin, camera.eye);
      }
    }
  }
}

// CLAIM      RT.1: u_s = l + (r−l)(i+½)/n_x, v_s = b + (t−b)(j+½)/n_y, n_s = ν names the same ray as IU.5.2, for every
//            ν.
// ORACLE     metamorphic: two formulas for one ray, over random cameras and distances of the view plane.
// TOLERANCE  kSameRayError, derived above.
TEST(CameraRays, AreTheSameThroughAWindow) {
  proves({"RT.1", "IU.5.2"}, Oracle::metamorphic, "the viewing system of [IU] against the window of [RT]");
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> distance(0.01, 100);
  for (int trial = 0; trial < 200; ++trial) {
    const Camera camera = random_camera(random);
    const CameraFrame frame = camera_frame(camera).value();
    const ViewWindow window = view_window(frame, distance(random));
    for (int j = 0; j < camera.rows; ++j) {
      for (int i = 0; i < camera.columns; ++i) {
        const Ray one = eye_ray(frame, picture_point(camera, i, camera.rows - 1 - j));
        const Ray other = window_ray(frame, window, camera, i, j);
        const double scale = 1 + frame.tan_horizontal + frame.tan_vertical;
        ASSERT_TRUE(within((one.direction - other.direction).norm(), kSameRayError * scale));
      }
    }
  }
}

// CLAIM      IU.5.2: the picture's origin is its lower left corner; inside a pixel `across` counts from the left, `down` from the
//            top edge.
// ORACLE     table: corners and points of a picture of 4 × 2 pixels.
// TOLERANCE  none: dyadic numbers.
TEST(CameraRays, CountFromTheLowerLeftCorner) {
  proves({"IU.5.2"}, Oracle::table, "points of a picture of 4 × 2 pixels");
  Camera camera;
  camera.columns = 4;
  camera.rows = 2;
  const auto is = [](const PicturePoint& point, double x, double y) { return point.x == x && point.y == y; };
  EXPECT_TRUE(holds(is(picture_point(camera, 0, 1, 0, 1), 0, 0)));
  EXPECT_TRUE(holds(is(picture_point(camera, 3, 0, 1, 0), 1, 1)));
  EXPECT_TRUE(holds(is(picture_point(camera, 0, 0), 0.125, 0.75)));
  EXPECT_TRUE(holds(is(picture_point(camera, 1, 0, 0.25, 0.25), 0.3125, 0.875)));
  EXPECT_TRUE(holds(is(picture_point(camera, 2, 1, 0.75, 0.75), 0.6875, 0.125)));
}

// CLAIM      G11: square pixels give tan φ = tan θ · R_y/R_x; scaling the angle instead is wrong (25.31° for 29.36° at
//            θ = 45°, 16:9). A gaze along "up" has no picture plane and is refused.
// ORACLE     closed form: atan(9/16) and 45° · 9/16.
// TOLERANCE  64 u in the angle: the direction's error, and that of the arc cosine at 29°.
TEST(CameraRays, ScaleTheTangentNotTheAngle) {
  proves({"G11", "IU.5.2"}, Oracle::closed_form, "atan(9/16), against 45° · 9/16");
  Camera camera;
  camera.horizontal_half_angle = 45 * kDegree;
  camera.columns = 1600;
  camera.rows = 900;
  const CameraFrame frame = camera_frame(camera).value();
  const Ray top = eye_ray(frame, {0.5, 1});
  const double phi = std::acos(top.direction.dot(frame.forward));
  EXPECT_TRUE(near(phi, std::atan(9.0 / 16), 64 * kUnitRoundoff));
  EXPECT_TRUE(near(phi / kDegree, 29.36, 0.005));
  const double scaled_angle = 45.0 * 9 / 16;
  EXPECT_TRUE(near(scaled_angle, 25.31, 0.005));
  // Square pixels: a step of one pixel is as long upwards as across, on the view plane.
  const auto on_plane = [&](const Ray& ray) { return Vec3(ray.direction / ray.direction.dot(frame.forward)); };
  const Vec3 centre = on_plane(eye_ray(frame, picture_point(camera, 800, 450)));
  const double across = (on_plane(eye_ray(frame, picture_point(camera, 801, 450))) - centre).norm();
  const double upwards = (on_plane(eye_ray(frame, picture_point(camera, 800, 449))) - centre).norm();
  EXPECT_TRUE(near(upwards, across, 8 * kUnitRoundoff));  // differences of numbers near one

  camera.up = 3 * camera.gaze;
  const auto refused = camera_frame(camera);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("parallel"), std::string::npos);
}

}  // namespace
}  // namespace etendue::validation
