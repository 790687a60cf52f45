// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

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

// CLAIM      IU.5.7: of what a picture is made of by brute force, nine steps in ten are intersection tests; by bounding volumes at most half as
//            many are left.
// ORACLE     identity: counted: the tests, and all else that is done once for each: a ray is made, a hit is shaded (as many as rays of
//            the tree at most), a sample is filtered.
// TOLERANCE  none; nine tenths are the text's, of time.
TEST(MirrorScene, IsMostlyIntersectionTests) {
  proves({"IU.5.7"}, Oracle::identity, "counted steps");
  const auto steps = [](const RenderCounts& counts) {
    return counts.rays() + (counts.eye_rays + counts.reflected_rays) + counts.eye_rays;
  };
  const Scene scene = mirrors(48);
  const RenderCounts brute = rendered(scene, AcceleratorKind::brute_force, 12, 2, 1).counts;
  EXPECT_TRUE(holds(brute.tests.surfaces > 9 * steps(brute))) << brute.tests.surfaces << " and " << steps(brute);
  const RenderCounts volumes = rendered(scene, AcceleratorKind::bounding_volumes, 12, 2, 1).counts;
  EXPECT_TRUE(holds(2 * volumes.tests.surfaces < brute.tests.surfaces)) << volumes.tests.surfaces;
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

// CLAIM      IU.f49, its content: 9 spheres, 9 cylinders, 2 polygons with global reflectivity 0.9 and nothing else, 1 plane, 2 discs
//            (and the floor, a box, which the text describes without counting it); only the big ball has a local specular part, 0.9; two
//            point lights of 1, ambient 0.3, 500 × 500.
// ORACLE     table: the figure's description.
// TOLERANCE  none.
TEST(MirrorScene, HoldsWhatTheTextCounts) {
  proves({"IU.f49"}, Oracle::table, "the description of figure 49");
  const Scene scene = read_scene(source_root() / "scenes" / "mirrors" / "scene.json").value().scene;
  std::size_t spheres = 0, cylinders = 0, polygons = 0, planes = 0, discs = 0, glossy = 0;
  std::size_t chequered = 0, wooden = 0;
  for (const Object& object : scene.objects) {
    const Material& material = scene.materials[object.material];
    spheres += std::holds_alternative<Sphere>(object.shape);
    cylinders += std::holds_alternative<Cylinder>(object.shape);
    planes += std::holds_alternative<Plane>(object.shape);
    discs += std::holds_alternative<Disc>(object.shape);
    if (const auto& pattern = material.pattern) {
      chequered += std::holds_alternative<Checkerboard>(pattern->pattern);
      wooden += std::holds_alternative<Wood>(pattern->pattern);
    }
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
  EXPECT_TRUE(holds(spheres == 9)) << spheres;
  EXPECT_TRUE(holds(cylinders == 9)) << cylinders;
  EXPECT_TRUE(holds(polygons == 2)) << polygons;
  EXPECT_TRUE(holds(planes == 1)) << planes;
  EXPECT_TRUE(holds(discs == 2)) << discs;
  EXPECT_EQ(scene.objects.size(), 9u + 9 + 2 + 1 + 2 + 1);  // and the uncounted floor
  EXPECT_EQ(chequered, 1u);
  EXPECT_EQ(wooden, 9u + 2);  // frames, stand and foot
  EXPECT_TRUE(holds(glossy == 1)) << glossy;
  ASSERT_EQ(scene.lights.size(), 2u);
  for (const Light& light : scene.lights) EXPECT_TRUE((std::get<PointLight>(light).intensity == 1).all());
  EXPECT_TRUE((scene.ambient == 0.3).all());
  EXPECT_EQ(scene.camera.columns, 500);
  EXPECT_EQ(scene.camera.rows, 500);
}

Rendering as_figure_49(const Scene& scene, SamplingScheme scheme, int samples, const std::optional<PixelWindow>& crop) {
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  RenderOptions options;
  options.limits.depth = 12;
  options.sampling.scheme = scheme;
  options.sampling.samples_per_side = samples;
  options.crop = crop;
  const bool whole = !crop;
  if (whole) options.filter = usual_filter(FilterKind::gaussian);
  return render(*accelerator, options, {}).value();
}

/// What figure 49 asked for before: guards against changes, and prove nothing.
constexpr std::uint64_t kGoldenEye = 827'770, kGoldenReflected = 396'759, kGoldenShadow = 1'494'214;

// CLAIM      IU.f49 as the text renders it, 500 × 500, depth 12, adaptive with 16 jittered samples, Gaussian filter: between one and 16 samples a
//            pixel, a tenth of the light lost at each mirror, shadows lit by the ambient light alone.
// ORACLE     identity: 0.9 to the number of mirrors; 0.3 k_a where no light reaches.
// TOLERANCE  one rounding a mirror; four of the colour.
TEST(MirrorScene, IsRenderedAsFigure49) {
  proves({"IU.f49"}, Oracle::identity, "0.9 a mirror; 0.3 k_a in the shadow");
  const Scene scene = mirrors(500);
  const Rendering rendering = as_figure_49(scene, SamplingScheme::adaptive_jittered, 4, std::nullopt);
  EXPECT_TRUE(holds(rendering.counts.eye_rays > 250'000 && rendering.counts.eye_rays < 16 * 250'000));
  EXPECT_EQ(rendering.counts.cut_by_depth, 0u);
  EXPECT_EQ(rendering.counts.transmitted_rays, 0u);
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const CameraFrame frame = camera_frame(scene.camera).value();
  std::size_t deep = 0, dark = 0;
  for (int row = 0; row < 500; row += 5) {
    for (int column = 0; column < 500; column += 5) {
      const RayTree tree = trace(eye_ray(frame, picture_point(scene.camera, column, row)), *accelerator, {12, 0});
      const RayNode& last = tree.nodes.back();
      if (last.level > 1) {
        ++deep;
        EXPECT_TRUE(near(last.weight, std::pow(0.9, last.level), last.level * 0x1p-52));
      }
      if (last.level > 0 || !last.hit) continue;
      bool lit = false;
      for (const Light& light : scene.lights) {
        const Vec3 way = std::get<PointLight>(light).position - last.hit->hit.point;
        const bool before = last.hit->hit.normal.dot(way) > 0;
        lit = lit || (before && !accelerator->obstruction(shadow_ray(last.hit->hit, light)).blocked);
      }
      if (lit) continue;
      ++dark;
      const Material& material = scene.materials[scene.objects[last.hit->object].material];
      const Rgb expected = 0.3 * colour_at(material, last.hit->hit.point).k_a;
      const Rgb found = shade(tree, *accelerator).colour;
      EXPECT_TRUE(near(found[0], expected[0], 4 * 0x1p-53));
    }
  }
  EXPECT_GT(deep, 50u);
  EXPECT_GT(dark, 20u);
  proves({}, Oracle::table, "our own earlier counts of rays: a guard, no proof");
  EXPECT_TRUE(holds(rendering.counts.eye_rays == kGoldenEye)) << rendering.counts.eye_rays;
  EXPECT_TRUE(holds(rendering.counts.reflected_rays == kGoldenReflected)) << rendering.counts.reflected_rays;
  EXPECT_TRUE(holds(rendering.counts.shadow_rays == kGoldenShadow)) << rendering.counts.shadow_rays;
}

// CLAIM      IU.f52, IU.f53: on a corner of figure 49 with 1, 4 and 9 uniform samples, and with 1, 4 and 9 jittered ones, the picture improves with
//            the samples; nine of either kind are close to each other, closer than one of each.
// ORACLE     metamorphic: the same corner with 1,024 jittered samples of another seed.
// TOLERANCE  none: errors are compared.
TEST(MirrorScene, ImprovesWithSamplesAsInFigures52And53) {
  proves({"IU.f52", "IU.f53"}, Oracle::metamorphic, "1,024 samples a pixel");
  const Scene scene = mirrors(500);
  const PixelWindow corner{95, 115, 145, 165};
  const auto picture = [&](SamplingScheme scheme, int n) { return as_figure_49(scene, scheme, n, corner).image; };
  const auto apart_by = [](const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += (a.pixels[i] - b.pixels[i]).square().sum();
    return std::sqrt(sum / static_cast<double>(3 * a.pixels.size()));
  };
  const Image truth = picture(SamplingScheme::jittered, 32);
  std::array<Image, 4> uniform, jittered;
  for (int n = 1; n <= 3; ++n) {
    uniform.at(static_cast<std::size_t>(n)) = picture(SamplingScheme::uniform, n);
    jittered.at(static_cast<std::size_t>(n)) = picture(SamplingScheme::jittered, n);
  }
  for (const auto* kind : {&uniform, &jittered}) {
    const double one = apart_by((*kind)[1], truth), four = apart_by((*kind)[2], truth),
                 nine = apart_by((*kind)[3], truth);
    EXPECT_TRUE(holds(nine < four && four < one && one > 0)) << one << " " << four << " " << nine;
  }
  EXPECT_TRUE(holds(apart_by(uniform[3], jittered[3]) < apart_by(uniform[1], jittered[1])));
}

}  // namespace
}  // namespace etendue::validation
