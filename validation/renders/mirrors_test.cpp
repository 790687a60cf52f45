// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "etendue/io/scene_reader.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/raytracing/render.hpp"
#include "support/evidence.hpp"
#include "support/image_compare.hpp"
#include "support/process.hpp"

namespace etendue::validation {
namespace {

Scene mirrors(int side) {
  auto file = read_scene(source_root() / "scenes" / "mirrors" / "scene.json");
  EXPECT_TRUE(file.ok()) << file.error().message;
  Scene scene = file.value().scene;
  scene.camera.columns = scene.camera.rows = side;
  return scene;
}

Rendering rendered(const Scene& scene, AcceleratorKind kind, int depth, int samples, int threads) {
  const auto accelerator = make_accelerator(scene, kind);
  RenderOptions options;
  options.limits.depth = depth;
  options.sampling.samples_per_side = samples;
  Execution execution;
  execution.threads = threads;
  return render(*accelerator, options, execution).value();
}

std::uint64_t different_pixels(const Image& a, const Image& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if ((a.pixels[i] != b.pixels[i]).any()) ++count;
  }
  return count;
}

// CLAIM      A picture has the same bits with 1, 2 and 7 threads, and with brute force and bounding volumes.
// ORACLE     metamorphic: the same picture, computed in other ways.
// TOLERANCE  none: all bits.
TEST(MirrorScene, HasTheSameBitsHoweverItIsComputed) {
  proves({"IU.5.7", "IU.5.7.1"}, Oracle::metamorphic, "1, 2 and 7 threads, two accelerators: one picture");
  const Scene scene = mirrors(48);
  const auto reference = rendered(scene, AcceleratorKind::brute_force, 12, 2, 1);
  ASSERT_TRUE(reference.complete);
  for (const int threads : {1, 2, 7}) {
    const auto other = rendered(scene, AcceleratorKind::bounding_volumes, 12, 2, threads);
    EXPECT_TRUE(all_agree(different_pixels(reference.image, other.image), other.image.pixels.size()));
    EXPECT_EQ(other.counts.rays(), reference.counts.rays());
    EXPECT_LT(other.counts.tests.surfaces, reference.counts.tests.surfaces);
  }
}

// CLAIM      IU.f51: at depth 0 the wall mirror is black and the rest as it will stay; at depth 1 it shows one reflection, in which
//            the other mirror is black; each further level fills in reflections of one order more and changes nothing else.
// ORACLE     identity: a pixel at depth D is final if its path of mirrors ends within D; else it is black, for the mirrors
//            have nothing but their reflection.
// TOLERANCE  none: all bits.
TEST(MirrorScene, GainsOneReflectionALevel) {
  proves({"IU.f51", "IU.5.5"}, Oracle::identity, "pixels by the number of mirrors on their path");
  const Scene scene = mirrors(64);
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const CameraFrame frame = camera_frame(scene.camera).value();
  const Image final_image = rendered(scene, AcceleratorKind::bounding_volumes, 12, 1, 0).image;
  std::array<std::uint64_t, 13> of_order{};
  for (int depth = 0; depth <= 3; ++depth) {
    const Image image = rendered(scene, AcceleratorKind::bounding_volumes, depth, 1, 0).image;
    std::uint64_t wrong = 0;
    for (int row = 0; row < 64; ++row) {
      for (int column = 0; column < 64; ++column) {
        const RayTree tree = trace(eye_ray(frame, picture_point(scene.camera, column, row)), *accelerator, {12, 0});
        const std::size_t order = tree.nodes.size() - 1;  // mirrors only reflect: the tree is one path
        ++of_order.at(order);
        const Rgb expected = order > static_cast<std::size_t>(depth) ? Rgb(0, 0, 0) : final_image.at(column, row);
        if ((image.at(column, row) != expected).any()) ++wrong;
      }
    }
    EXPECT_TRUE(all_agree(wrong, 64 * 64));
  }
  for (const std::size_t order : {0u, 1u, 2u, 3u}) EXPECT_GT(of_order[order], 10u) << order;
}

// CLAIM      The mirror scene looks as it did: a guard against changes, no proof of anything (the proofs are the known renders).
//            Made by: etendue render scenes/mirrors/scene.json --columns 64 --samples 1 --output scenes/mirrors/reference.exr
// ORACLE     table: the stored picture, our own earlier output. Missing, it fails.
// TOLERANCE  2^-23, relatively: the file holds floats.
TEST(MirrorScene, LooksAsItDid) {
  proves({}, Oracle::table, "scenes/mirrors/reference.exr, our own earlier output: a guard, no proof");
  const Image image = rendered(mirrors(64), AcceleratorKind::bounding_volumes, 12, 1, 0).image;
  const auto found = compare_with_file(image, source_root() / "scenes" / "mirrors" / "reference.exr", 0, 0x1p-23);
  EXPECT_TRUE(found.agrees()) << found.message;
  EXPECT_TRUE(all_agree(found.pixels_above, image.pixels.size()));
}

// CLAIM      IU.f49, its content: 9 spheres, 9 cylinders, 2 polygons with global reflectivity 0.9 and nothing else, 1 plane (and
//            the floor, which the text describes without counting it), 2 discs; only the big ball has a local specular part, 0.9; two
//            point lights of 1, ambient 0.3, 500 × 500.
// ORACLE     table: the figure's description.
// TOLERANCE  none.
TEST(MirrorScene, HoldsWhatTheTextCounts) {
  proves({}, Oracle::table, "the description of figure 49 (adaptive sampling, filter and patterns are not built)");
  const Scene scene = read_scene(source_root() / "scenes" / "mirrors" / "scene.json").value().scene;
  std::size_t spheres = 0, cylinders = 0, polygons = 0, planes = 0, discs = 0, glossy = 0;
  for (const Object& object : scene.objects) {
    const Material& material = scene.materials[object.material];
    spheres += std::holds_alternative<Sphere>(object.shape);
    cylinders += std::holds_alternative<Cylinder>(object.shape);
    planes += std::holds_alternative<Plane>(object.shape);
    discs += std::holds_alternative<Disc>(object.shape);
    const bool mirror = std::holds_alternative<Polygon>(object.shape);
    polygons += mirror;
    EXPECT_EQ(material.k_r, mirror ? 0.9 : 0.0) << object.name;
    EXPECT_EQ(material.k_t, 0) << object.name;
    EXPECT_EQ((material.k_d == 0).all(), mirror) << object.name;
    if (material.k_s != 0) {
      ++glossy;
      EXPECT_EQ(object.name, "ball");
      EXPECT_EQ(material.k_s, 0.9);
    }
  }
  EXPECT_EQ(spheres, 9u);
  EXPECT_EQ(cylinders, 9u);
  EXPECT_EQ(polygons, 2u);
  EXPECT_EQ(planes, 1u + 1u);  // wall, and the uncounted floor
  EXPECT_EQ(discs, 2u);
  EXPECT_EQ(glossy, 1u);
  ASSERT_EQ(scene.lights.size(), 2u);
  for (const Light& light : scene.lights) EXPECT_TRUE((std::get<PointLight>(light).intensity == 1).all());
  EXPECT_TRUE((scene.ambient == 0.3).all());
  EXPECT_EQ(scene.camera.columns, 500);
  EXPECT_EQ(scene.camera.rows, 500);
}

}  // namespace
}  // namespace etendue::validation
