// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/raytracing/shading_normal.hpp"
#include "etendue/view/shaded_view.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/scene_builder.hpp"

// Figure 23: a torus with bumps, beside the smooth one.
namespace etendue::validation {
namespace {

constexpr int kColumns = 160, kRows = 120;

Scene torus_named(const std::string& file) {
  auto read = read_scene(source_root() / "scenes/bump-torus" / (file + ".json"));
  EXPECT_TRUE(read.ok()) << file;
  Scene scene = read.ok() ? read->scene : Scene{};
  scene.camera.columns = kColumns;
  scene.camera.rows = kRows;
  return scene;
}

struct Pictures {
  Image traced, object, depth, normal, drawn;
};

Pictures pictures_of(const Scene& scene) {
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  RenderOptions options;
  options.sampling.samples_per_side = 1;
  options.facts = {PictureFact::object, PictureFact::depth, PictureFact::normal};
  auto traced = render(*accelerator, options, {});
  ShadingOptions shading;
  shading.samples = 1;
  shading.net.facets = 256;
  auto drawn = view_shaded(scene, shading);
  EXPECT_TRUE(traced.ok() && drawn.ok());
  return {traced->image, traced->facts[0], traced->facts[1], traced->facts[2], drawn->image};
}

// CLAIM      IU.f23, IU.4.2.1: bumps of any kind leave the silhouette as it is, pixel for pixel, and every depth and geometric normal, by
//            rays and by rasteriser; what they change is how the ring is shaded, in most of its pixels.
// ORACLE     metamorphic: the same pictures of the smooth torus.
// TOLERANCE  none: the same bits.
TEST(BumpTorus, HasTheSilhouetteOfTheSmoothOne) {
  proves({"IU.f23", "IU.4.2.1"}, Oracle::metamorphic, "pictures of the smooth torus");
  const Scene smooth_scene = torus_named("smooth");
  const Pictures smooth = pictures_of(smooth_scene);
  for (const char* const name : {"scene", "waves", "table", "rough"}) {
    const Scene scene = torus_named(name);
    const Pictures rough = pictures_of(scene);
    std::uint64_t moved = 0, ring = 0, shaded = 0, redrawn = 0;
    for (std::size_t i = 0; i < smooth.traced.pixels.size(); ++i) {
      const bool here = smooth.object.pixels[i][0] >= 0;
      moved += (rough.object.pixels[i] != smooth.object.pixels[i]).any() ? 1u : 0u;
      moved += (rough.depth.pixels[i] != smooth.depth.pixels[i]).any() ? 1u : 0u;
      moved += (rough.normal.pixels[i] != smooth.normal.pixels[i]).any() ? 1u : 0u;
      if (!here) moved += (rough.traced.pixels[i] != scene.background).any() ? 1u : 0u;
      const bool drawn = (smooth.drawn.pixels[i] != scene.background).any();
      moved += (rough.drawn.pixels[i] != scene.background).any() != drawn ? 1u : 0u;
      ring += here ? 1u : 0u;
      shaded += (rough.traced.pixels[i] - smooth.traced.pixels[i]).abs().maxCoeff() > 0.01 ? 1u : 0u;
      redrawn += (rough.drawn.pixels[i] - smooth.drawn.pixels[i]).abs().maxCoeff() > 0.01 ? 1u : 0u;
    }
    EXPECT_TRUE(all_agree(moved, 5 * smooth.traced.pixels.size())) << name;
    EXPECT_TRUE(holds(shaded > ring / 2 && redrawn > ring / 2)) << name << ": " << shaded << " of " << ring;
  }
}

// CLAIM      IU.4.2.1: both methods shade a bump alike, for the rasteriser asks for the same normal at nearly the same point.
// ORACLE     another method: the ray tracer at the pixels' centres, the lamp beside the eye, so that there are no shadows.
// TOLERANCE  of 256 facets the nearest point is within tube (1 − cos π/128) and R (1 − cos π/256) of the ring, 1e-3 of a wave:
//            measured, 0.02 in all but 1 % of the ring's pixels, which lie at outlines and where light grazes.
TEST(BumpTorus, IsShadedAlikeByBothMethods) {
  proves({"IU.4.2.1"}, Oracle::program, "the ray tracer at the same pixels");
  Scene scene = torus_named("scene");
  scene.lights = {DirectionalLight{Vec3(0.1, -16, 11.5).normalized(), Rgb::Ones()}};
  const Pictures both = pictures_of(scene);
  std::uint64_t ring = 0, unlike = 0;
  for (std::size_t i = 0; i < both.traced.pixels.size(); ++i) {
    if (both.object.pixels[i][0] < 0) continue;
    ++ring;
    unlike += (both.traced.pixels[i] - both.drawn.pixels[i]).abs().maxCoeff() > 0.02 ? 1u : 0u;
  }
  EXPECT_TRUE(holds(ring > 2000 && unlike * 100 < ring)) << unlike << " of " << ring;
}

// CLAIM      IU.4.2.1: no light leaks through a surface because of its bumps. What the smooth surface has its back to a lamp shows nothing but
//            ambient light, by both methods, and no mirrored ray leads into the ring.
// ORACLE     identity: signs of scalar products with the smooth normal.
// TOLERANCE  none; the ambient part is one product, the same by both. A net of triangles has its outlines elsewhere: of its picture
//            count the pixels that lie among others in shade.
TEST(BumpTorus, LetsNoLightThrough) {
  proves({"IU.4.2.1"}, Oracle::identity, "signs of products with the smooth normal");
  Scene scene = torus_named("scene");
  scene.lights = {DirectionalLight{Vec3(0.6, 0.8, 0), Rgb::Ones()}};
  Material& skin = scene.materials[scene.objects[0].material];
  skin.k_r = 0.5;
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const Pictures dark = pictures_of([&] {
    Scene matt = scene;
    matt.materials[scene.objects[0].material].k_r = 0;
    return matt;
  }());
  const Rgb ambient = skin.k_a * scene.ambient;
  std::uint64_t leaks = 0, behind = 0, inside = 0, mirrored = 0, turned = 0;
  std::vector<std::array<int, 2>> in_shade;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Ray ray = eye_ray(*camera_frame(scene.camera), picture_point(scene.camera, column, row));
      const RayTree tree = trace(ray, *accelerator, {3, 0});
      for (const RayNode& node : tree.nodes) {
        if (node.kind != RayKind::reflected) continue;
        const RayNode& from = tree.nodes[node.parent];
        const Vec3& normal = from.hit->hit.normal;
        ++mirrored;
        inside += normal.dot(node.ray.direction) * normal.dot(from.ray.direction) > 0 ? 1u : 0u;
      }
      const auto& hit = tree.nodes[0].hit;
      if (!hit || hit->hit.normal.dot(Vec3(0.6, 0.8, 0)) > -0.02) continue;
      ++behind;
      const Vec3 rough = shading_normal(*skin.bump, scene.objects[0].shape, hit->hit.point, hit->hit.normal);
      turned += rough.dot(Vec3(0.6, 0.8, 0)) > 0 ? 1u : 0u;
      leaks += (dark.traced.at(column, row) != ambient).any() ? 1u : 0u;
      in_shade.push_back({column, row});
    }
  }
  EXPECT_TRUE(all_agree(leaks, behind));
  std::uint64_t drawn_leaks = 0, surrounded = 0;
  for (const auto& [column, row] : in_shade) {
    bool inner = true;
    for (const std::array<int, 2> step : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const std::array<int, 2> beside{column + step[0], row + step[1]};
      inner = inner && std::find(in_shade.begin(), in_shade.end(), beside) != in_shade.end();
    }
    surrounded += inner ? 1u : 0u;
    drawn_leaks += inner && (dark.drawn.at(column, row) != ambient).any() ? 1u : 0u;
  }
  EXPECT_TRUE(all_agree(drawn_leaks, surrounded));
  EXPECT_TRUE(all_agree(inside, mirrored));
  EXPECT_TRUE(holds(turned > 100 && behind > 1000)) << turned << " slopes would see the lamp through the ring";
}

// CLAIM      IU.4.2.1: heights stand on the side of the surface's own normal, also where it is seen from behind: hills of a polygon are hollows of the
//            same polygon wound the other way round, by both methods.
// ORACLE     metamorphic: the reversed polygon with the negative height.
// TOLERANCE  of N·L and R·V, 14 u each, times what R·V to the power of 8 makes of it. The rasteriser cuts the reversed polygon into
//            other triangles, whose corners are snapped to 1/4096 pixel: 0.15/8192 of a length, times slopes of intensity below 10.
TEST(BumpTorus, TurnsHillsIntoHollowsBehind) {
  proves({"IU.4.2.1"}, Oracle::metamorphic, "the reversed polygon with the negative height");
  const auto pictures = [](bool reversed, double height) {
    Scene scene;
    scene.camera = straight(40, 30);
    scene.lights = {PointLight{{2, -1, -1}, {0.8, 0.7, 0.6}}};
    Material skin = diffuse(0.5);
    skin.k_s = 0.4;
    skin.phong_exponent = 8;
    MaterialBump::Lay lay;
    lay.size = 0.7;
    skin.bump = MaterialBump{WaveRelief{height, 1, 1}, lay};
    std::vector<Vec3> corners{{-3, -2, 3}, {3, -2, 3.5}, {3, 2, 3.5}, {-3, 2, 3}};
    if (reversed) std::reverse(corners.begin(), corners.end());
    add(scene, Polygon::make(corners).value(), skin);
    return pictures_of(scene);
  };
  constexpr double kTolerance = 64 * 8 * 0x1p-53, kSnapping = 2e-4;
  const Pictures hills = pictures(false, 0.05), hollows = pictures(true, -0.05), others = pictures(true, 0.05);
  double apart = 0;
  for (std::size_t i = 0; i < hills.traced.pixels.size(); ++i) {
    EXPECT_TRUE(within((hills.traced.pixels[i] - hollows.traced.pixels[i]).abs().maxCoeff(), kTolerance));
    EXPECT_TRUE(within((hills.drawn.pixels[i] - hollows.drawn.pixels[i]).abs().maxCoeff(), kSnapping));
    apart = std::max(apart, (hills.traced.pixels[i] - others.traced.pixels[i]).abs().maxCoeff());
  }
  EXPECT_GT(apart, 0.1);
}

}  // namespace
}  // namespace etendue::validation
