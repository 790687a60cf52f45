// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/render.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

/// What the pixel in the middle of the picture sees from `eye` along `gaze`.
double middle(Scene scene, const Vec3& eye, const Vec3& gaze) {
  scene.camera.eye = eye;
  scene.camera.gaze = gaze;
  scene.camera.columns = scene.camera.rows = 3;
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  RenderOptions options;
  options.sampling.samples_per_side = 1;
  const auto picture = render(*accelerator, options, Execution{});
  if (!picture) throw std::runtime_error(picture.error().message);
  return picture->image.at(1, 1)[0];
}

// CLAIM      IU.5.4a: a light inside an opaque solid lights it from inside, and nothing outside: the solid's outside
//            and the floor under it are black.
// ORACLE     closed form: on the axis light arrives at a right angle, k_d = ½ of its intensity comes back.
// TOLERANCE  8 u: the cosine of a normal and a direction that are each normalised, one product. Black is 0.
TEST(LightInASolid, ShinesInsideOnly) {
  proves({"IU.5.4a"}, Oracle::closed_form, "k_d times cos 0, or nothing");
  const std::vector<Shape> solids{Sphere{{0, 0, 0}, 1}, Box{{0, 0, 0}, Mat3::Identity(), Vec3::Ones()},
                                  Quadric{Mat3::Identity(), Vec3::Zero(), -1, {{0, 0, 0}, Mat3::Identity(), {2, 2, 2}}},
                                  Torus{{0, -3, 0}, {0, 0, 1}, 3, 1}};
  for (const Shape& solid : solids) {
    Scene scene;
    add(scene, solid, diffuse(0.5));
    add(scene, Plane{{0, 0, -2}, {0, 0, 1}}, diffuse(0.5));
    scene.lights = {PointLight{{0, 0, 0}, Rgb::Ones()}};
    EXPECT_TRUE(near(middle(scene, {0, 0, 0}, {0, 1, 0}), 0.5, 8 * 0x1p-53));
    EXPECT_TRUE(near(middle(scene, {0.25, 8, 0.25}, {0, -1, 0}), 0, 0));
    EXPECT_TRUE(near(middle(scene, {5, 5, 5}, Vec3(3, 3, -2) - Vec3(5, 5, 5)), 0, 0));
    // The same floor is lit where the light is outside.
    scene.lights = {PointLight{{3, 3, 3}, Rgb::Ones()}};
    EXPECT_TRUE(near(middle(scene, {5, 5, 5}, Vec3(3, 3, -2) - Vec3(5, 5, 5)), 0.5, 8 * 0x1p-53));
  }
}

}  // namespace
}  // namespace etendue::validation
