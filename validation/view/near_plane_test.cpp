// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/facets.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"
#include "support/single_samples.hpp"

namespace etendue::validation {
namespace {

/// A ball of 5 mm on a floor, the eye 3 cm before it and 2 cm above.
Scene marble_on_a_floor(double half) {
  Scene scene;
  scene.camera = straight(60, 40);
  scene.camera.eye = {0, -0.03, 0.02};
  scene.camera.gaze = Vec3(0, 0.03, -0.015);
  scene.camera.up = Vec3::UnitZ();
  scene.camera.horizontal_half_angle = 0.45;
  scene.background = {0.1, 0.2, 0.8};
  scene.ambient = Rgb::Ones();
  add(scene, square({0, 0, 0}, Vec3::UnitZ(), half), diffuse(0.9));
  add(scene, Sphere{{0, 0, 0.005}, 0.005}, diffuse(0.4));
  return scene;
}

// CLAIM      IU.5.2: what lies near the eye is drawn however far the scene reaches: the plane before which the rasteriser cuts is not in its
//            way, with floors from 10 m to 2,000 km.
// ORACLE     another method: the ray tracer at the same pixels.
// TOLERANCE  pixels that the ball's outline crosses may differ, a facet being as far from the ball as 1 − cos(π/96) of its radius: 2 % of all.
TEST(NearPlane, CutsNothingThatIsSeen) {
  proves({"IU.5.2"}, Oracle::program, "the ray tracer at the same pixels");
  for (const double half : {10.0, 1e3, 2e4, 1e6}) {
    const Scene scene = marble_on_a_floor(half);
    const Image rays = traced_once(scene).image, drawn = drawn_once(scene, 96);
    std::uint64_t unlike = 0;
    for (std::size_t i = 0; i < rays.pixels.size(); ++i) {
      unlike += (rays.pixels[i] - drawn.pixels[i]).abs().maxCoeff() > 1e-9 ? 1u : 0u;
    }
    EXPECT_TRUE(holds(unlike * 50 <= rays.pixels.size())) << half << ": " << unlike << " of " << rays.pixels.size();
  }
}

// CLAIM      IU.5.2: a plane through the eye, of which nothing is seen, leaves the rest of the picture as it is.
// ORACLE     another method: the ray tracer at the same pixels; and the length is positive, as Projection wants.
// TOLERANCE  as above: 2 % of the pixels.
TEST(NearPlane, IsBeforeAnEyeInAPlane) {
  proves({"IU.5.2"}, Oracle::program, "the ray tracer at the same pixels");
  Scene scene = marble_on_a_floor(10);
  scene.camera.rows = 41;
  add(scene, Plane{{0, 0, 0.02}, Vec3::UnitZ()}, diffuse(0.7));
  EXPECT_TRUE(holds(length_to_see(scene, facets_of(scene, {}).value()) > 0));
  const Image rays = traced_once(scene).image, drawn = drawn_once(scene, 96);
  std::uint64_t unlike = 0;
  for (std::size_t i = 0; i < rays.pixels.size(); ++i)
    unlike += (rays.pixels[i] - drawn.pixels[i]).abs().maxCoeff() > 1e-9 ? 1u : 0u;
  EXPECT_TRUE(holds(unlike * 50 <= rays.pixels.size())) << unlike << " of " << rays.pixels.size();
}

}  // namespace
}  // namespace etendue::validation
