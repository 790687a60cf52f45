// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "etendue/io/scene_reader.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/raytracing/render.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"

// The scenes of glass that are shipped, held against what the texts say of their pictures.
namespace etendue::validation {
namespace {

Scene shipped(const std::string& path) {
  return read_scene(source_root() / "scenes" / path).value().scene;
}

/// Name of what the ray through the picture's middle meets beyond all glass; empty if it leaves.
std::string seen_in_the_middle(const Scene& scene) {
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const auto frame = camera_frame(scene.camera).value();
  const RayTree tree = trace(eye_ray(frame, {}), *accelerator, {12, 0});
  std::string name;
  for (const RayNode& node : tree.nodes) {  // a chain: nothing is reflected
    if (node.hit) name = scene.objects[node.hit->object].name;
  }
  return name;
}

// CLAIM      IU.4.3c, figure 27: looking towards D from v1, one sees C, since A refracts; without refraction one would see D.
//            From v2, which looks towards C through B, one sees D, and without refraction C.
// ORACLE     table: the text's sentence, for both eyes, with the index of the scene and with 1.
// TOLERANCE  none.
TEST(RefractionScene, ShowsEachEyeTheOtherObject) {
  proves({"IU.4.3c"}, Oracle::table, "what each of figure 27's eyes sees with and without refraction");
  const auto seen = [](const char* file, bool refracts) {
    Scene scene = shipped(std::string("two-eyes/") + file);
    for (Material& material : scene.materials) {
      if (!refracts) material.eta = 1;
      material.k_r = 0;
    }
    return seen_in_the_middle(scene);
  };
  EXPECT_TRUE(holds(seen("scene.json", true) == "C"));
  EXPECT_TRUE(holds(seen("scene.json", false) == "D"));
  EXPECT_TRUE(holds(seen("second-eye.json", true) == "D"));
  EXPECT_TRUE(holds(seen("second-eye.json", false) == "C"));
}

// CLAIM      IU.f50: the globe has the index 1.3, the transmissivity 0.99 and the local specular part 0.9; there are one light, an
//            ambient one of 0.3, and 750 × 500 pixels. At depth 5 the light's highlight is seen on the outside, and on the
//            inside through the glass; the floor's shadow of the globe is weakened, most in the middle, not black.
// ORACLE     table: the text's numbers and its description of the picture.
// TOLERANCE  a highlight: half of the greatest that k_s allows, and of that times k_t for the light's way in and the eye's.
TEST(RefractionScene, IsTheGlassGlobeOfFigure50) {
  proves({"IU.f50", "IU.f50s"}, Oracle::table, "numbers and description of figure 50");
  const Scene scene = shipped("glass-globe/scene.json");
  const std::size_t globe =
      static_cast<std::size_t>(std::find_if(scene.objects.begin(), scene.objects.end(),
                                            [](const Object& each) { return each.name == "globe"; }) -
                               scene.objects.begin());
  ASSERT_LT(globe, scene.objects.size());
  const Material& glass = scene.materials[scene.objects[globe].material];
  EXPECT_TRUE(holds(glass.eta == 1.3 && glass.k_t == 0.99 && glass.k_s == 0.9 && glass.k_r == 0));
  EXPECT_TRUE(holds(std::holds_alternative<Sphere>(scene.objects[globe].shape)));
  EXPECT_TRUE(holds(scene.lights.size() == 1 && (scene.ambient == 0.3).all()));
  EXPECT_TRUE(holds(scene.camera.columns == 750 && scene.camera.rows == 500));

  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const auto frame = camera_frame(scene.camera).value();
  double outside = 0, inside = 0;
  int deepest = 0;
  for (int row = 0; row < 500; row += 4) {
    for (int column = 0; column < 750; column += 4) {
      const RayTree tree = trace(eye_ray(frame, picture_point(scene.camera, column, row)), *accelerator, {5, 0});
      for (const RayNode& node : tree.nodes) {
        deepest = std::max(deepest, node.level);
        if (!node.hit || node.hit->object != globe || node.level > 1) continue;
        double& highlight = node.level == 0 ? outside : inside;
        highlight = std::max(highlight, local_illumination(node, *accelerator).colour[1]);
      }
    }
  }
  EXPECT_TRUE(holds(outside > 0.5 * 0.9)) << outside;
  EXPECT_TRUE(holds(inside > 0.5 * 0.9 * 0.99 * 0.7)) << inside;
  EXPECT_TRUE(holds(2 <= deepest && deepest <= 6));

  // Along the shadow's middle line, from its middle outwards.
  const Sphere& ball = std::get<Sphere>(scene.objects[globe].shape);
  const Vec3 light = std::get<PointLight>(scene.lights[0]).position;
  const Vec3 across = (ball.centre - light).cross(Vec3::UnitZ()).normalized();
  double before = 0;
  for (const double share : {0.0, 0.3, 0.6, 0.9}) {
    const Vec3 through = ball.centre + share * ball.radius * across;
    const Vec3 direction = (through - light).normalized();
    const Vec3 foot = light - light.z() / direction.z() * direction;
    const Ray way{foot + 1e-6 * Vec3::UnitZ(), -direction, 0, (light - foot).norm()};
    const double left = passage(way, {0}, *accelerator, {}).share[0];
    EXPECT_TRUE(holds(left > before && left < 0.99 * 0.99)) << share;
    before = left;
  }
}

// CLAIM      The rainbow of the prism: through it, the white slit is blue above and red below, in parts of the visible light; with
//            a mean index it is as white as beside the prism.
// ORACLE     table: flint refracts blue more than red; the eye looks from below, the deviation is towards the base.
// TOLERANCE  none: the greatest channel of the uppermost and the lowest coloured pixel of the middle column.
TEST(RefractionScene, IsTheRainbowOfAPrism) {
  proves({"IU.4-6"}, Oracle::table, "the order of a prism's colours, and none with a mean index");
  const Scene scene = shipped("prism/scene.json");
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const auto frame = camera_frame(scene.camera).value();
  const auto column = [&](int wavelengths) {
    RenderOptions options;
    options.limits = {5, 1e-3};
    options.wavelengths = wavelengths;
    std::vector<Rgb> lit;
    for (int row = 0; row < scene.camera.rows; row += 2) {
      const PicturePoint point = picture_point(scene.camera, scene.camera.columns / 2, row);
      const Rgb seen = see(eye_ray(frame, point), *accelerator, options, {}).colour;
      if (seen.maxCoeff() > 0.1) lit.push_back(seen);
    }
    return lit;
  };
  const std::vector<Rgb> rainbow = column(40), white = column(0);
  ASSERT_GT(rainbow.size(), 30u);
  const Rgb &top = rainbow.front(), &bottom = rainbow.back();
  EXPECT_TRUE(holds(top[2] > top[0] && top[2] > 2 * top[1]));
  EXPECT_TRUE(holds(bottom[0] > 2 * bottom[1] && bottom[0] > 2 * bottom[2]));
  ASSERT_GT(white.size(), 0u);
  EXPECT_LT(white.size(), 10u);
  for (const Rgb& grey : white) EXPECT_TRUE(holds(grey[0] == grey[1] || std::abs(grey[2] - grey[0]) < 0.05));
}

}  // namespace
}  // namespace etendue::validation
