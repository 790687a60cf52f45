// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/gathered_view.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "meshing/small_scenes.hpp"
#include "oracles/element_rectangle.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

bool is_at(double coordinate, double wall) {
  return std::abs(coordinate - wall) < 1e-9;
}

/// Factor from a point of a unit cube's surface to its wall x = 0.
double to_the_wall(const Vec3& p) {
  // B-5: an element whose plane stands on the rectangle's, at distance c from it; the rectangle a high along the element's
  // normal, b wide from the foot of the perpendicular.
  const auto standing = [](double a, double b, double c) {
    const double x = a / b, y = c / b, root = std::hypot(x, y);
    return b == 0 ? 0 : (std::atan(1 / y) - y / root * std::atan(1 / root)) / (2 * std::numbers::pi);
  };
  double sum = 0;
  if (is_at(p.x(), 1)) {
    for (const double a : {p.y(), 1 - p.y()}) {
      for (const double b : {p.z(), 1 - p.z()}) sum += a > 0 && b > 0 ? oracle::element_to_corner_rectangle(a, b) : 0;
    }
    return sum;
  }
  const double along = std::min(p.z(), 1 - p.z()) < std::min(p.y(), 1 - p.y()) ? p.y() : p.z();
  return standing(1, along, p.x()) + standing(1, 1 - along, p.x());
}

// CLAIM      IU.6-7, IU.6-2, IU.6.5v: a gathered picture shows at each pixel E + ρ H of the very point that its centre's ray meets,
//            whatever the elements: of one emitting wall in a cube the closed form, on walls that have one element each; where the
//            ray meets the edge of two walls, too. With several samples a pixel of one wall shows it as one, and what shows two
//            walls shows as much of each as samples fell on it.
// ORACLE     closed form: element to parallel rectangle (B-4) in 600-bit balls, to a perpendicular one (B-5), written out above.
// TOLERANCE  2^-36 of the emission: points on an edge are moved off it by 2^-40 of an element, where slopes are below 2; all
//            else is rounding.
TEST(GatheredView, GathersTheClosedFormAtEveryPixel) {
  proves({"IU.6-7", "IU.6-2", "IU.6.5v"}, Oracle::closed_form, "B-4 at 600 bits and B-5, at what each pixel shows");
  Scene scene = room_of({0, 0, 0}, {1, 1, 1});
  Material light = scene.materials[0], red = light;
  light.emission = Rgb(4, 2, 1);
  red.rho = Rgb(0.9, 0.25, 0.125);
  scene.materials.push_back(light);
  scene.materials.push_back(red);
  scene.objects[2].material = 1;  // x = 0
  scene.objects[3].material = 2;  // x = 1
  const ElementMesh mesh = *mesh_elements(scene);
  std::vector<Rgb> radiosity(6, Rgb::Zero());
  radiosity[2] = light.emission;
  const RadiosityField field = constant_field(radiosity, Rgb::Zero());
  const auto expected = [&](const Vec3& p) {
    if (is_at(p.x(), 0)) return light.emission;
    return Rgb((is_at(p.x(), 1) ? red.rho : scene.materials[0].rho) * light.emission * to_the_wall(p));
  };
  const auto end = [](const Vec3& eye, const Vec3& d) {
    double nearest = 1e300;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (d(k) != 0) nearest = std::min(nearest, ((d(k) > 0 ? 1 : 0) - eye(k)) / d(k));
    }
    return Vec3(eye + nearest * d);
  };
  Camera camera;
  camera.up = Vec3(0, 0, 1);
  camera.horizontal_half_angle = 0.8;
  camera.columns = 21;
  camera.rows = 15;
  int beside_the_light = 0;
  for (const Vec3& gaze :
       {Vec3(-0.5, 0, -0.5), Vec3(0.5, 0.5, -0.5), Vec3(0.5, 0.1, 0.2), Vec3(0.25, 0.25, 0.5), Vec3(-1, 0.2, 0.1)}) {
    camera.eye = Vec3(0.5, 0.5, 0.5);  // the middle row of the first, the middle column of the second look at an edge
    camera.gaze = gaze;
    const auto picture = gather_radiosities(camera, scene, mesh, field, Rgb::Constant(-1), 1);
    ASSERT_TRUE(picture.ok());
    const Vec3 g = gaze.normalized(), x = g.cross(camera.up).normalized(), y = x.cross(g);
    for (int row = 0; row < camera.rows; ++row) {
      for (int column = 0; column < camera.columns; ++column) {
        const double s = 2 * (column + 0.5) / camera.columns - 1, t = 1 - 2 * (row + 0.5) / camera.rows;
        const Vec3 d = g + s * std::tan(0.8) * x + t * std::tan(0.8) * camera.rows / camera.columns * y;
        const Vec3 p = end(camera.eye, d);
        // Two walls meet there, and which of them is shown is a matter of rounding.
        if (is_at(p.x(), 1) && (is_at(p.y(), 0) || is_at(p.y(), 1) || is_at(p.z(), 0) || is_at(p.z(), 1))) continue;
        if (is_at(p.x(), 0) && is_at(p.z(), 0) && picture->at(column, row)(0) < 2) {
          // The floor's end at the light, which fills half of what it sees.
          EXPECT_TRUE(near(picture->at(column, row)(0), 0.5 * 4 / 2, 0x1p-36 * 4));
          ++beside_the_light;
          continue;
        }
        for (Eigen::Index c = 0; c < 3; ++c) {
          EXPECT_TRUE(near(picture->at(column, row)(c), expected(p)(c), 0x1p-36 * light.emission(c))) << p.transpose();
        }
      }
    }
  }
  EXPECT_GT(beside_the_light, 0);
  // From outside, through the back of x = 1: the middle of a wall, its edge, and what is beside it.
  camera.eye = Vec3(2, 0.5, 0.5);
  camera.gaze = Vec3(-1, 0, 0);
  camera.horizontal_half_angle = std::atan(0.375);  // 2 away the wall x = 0 is two thirds of 1.5 wide
  camera.columns = 3;
  camera.rows = 1;
  const auto outside = gather_radiosities(camera, scene, mesh, field, Rgb::Constant(-1), 2);
  ASSERT_TRUE(outside.ok());
  EXPECT_TRUE(near(outside->at(1, 0)(0), 4, 8 * 0x1p-53));
  // Two samples fall on the wall y = 1, at (0.4, 1, 0.5 ± 0.1).
  EXPECT_TRUE(near(outside->at(0, 0)(0), (4 + 0.5 * 4 * to_the_wall({0.4, 1, 0.6})) / 2, 0x1p-36 * 4));
}

// CLAIM      A camera that sees nothing definite is refused; a picture that is stopped says so.
// ORACLE     identity: such a camera, and a stop that is set.
// TOLERANCE  none.
TEST(GatheredView, RefusesAndStops) {
  proves({"IU.5.2", "G11"}, Oracle::identity, "a camera with its gaze along up; a stop");
  const Scene scene = room_of({0, 0, 0}, {1, 1, 1});
  const ElementMesh mesh = *mesh_elements(scene);
  const RadiosityField field = constant_field(std::vector<Rgb>(6, Rgb::Ones()), Rgb::Zero());
  Camera camera;
  camera.eye = Vec3(0.5, 0.5, 0.5);
  const std::atomic<bool> stop = true;
  const auto stopped = gather_radiosities(camera, scene, mesh, field, Rgb::Zero(), 1, {1, {}, &stop});
  EXPECT_TRUE(holds(!stopped && stopped.error().code == ErrorCode::stopped));
  camera.up = camera.gaze;
  const auto refused = gather_radiosities(camera, scene, mesh, field, Rgb::Zero(), 1);
  EXPECT_TRUE(holds(!refused && refused.error().code == ErrorCode::invalid_input));
}

}  // namespace
}  // namespace etendue::validation
