// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/render.hpp"

#include <atomic>
#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/raytracing/preview.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

/// Looks straight down on a plane whose part x < right, y < top shines; one unit wide and high in the picture.
Scene corner(double right, double top, int side) {
  Scene scene;
  Material bright;
  bright.emission = Rgb::Ones();
  add(scene, Polygon::make({{-9, -9, 0}, {right, -9, 0}, {right, top, 0}, {-9, top, 0}}).value(), bright);
  scene.camera.eye = {0.5, 0.5, 0.5};
  scene.camera.gaze = {0, 0, -1};
  scene.camera.up = {0, 1, 0};
  scene.camera.horizontal_half_angle = std::atan(1.0);  // the picture shows [0, 1] × [0, 1]
  scene.camera.columns = scene.camera.rows = side;
  return scene;
}

Rendering rendered(const Scene& scene, int samples, const Execution& execution = {}) {
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  RenderOptions options;
  options.sampling.samples_per_side = samples;
  return render(*accelerator, options, execution).value();
}

// CLAIM      IU.5.8.1, uniform supersampling with a box filter: a pixel is the share of its N × N sample points, the centres of
//            equal parts, that see the object; one sample in the centre sees all or nothing.
// ORACLE     closed form: a corner at (e, f) covers (i + (a + ½)/N)/R < e and (j + (b + ½)/N)/R < f: count them.
// TOLERANCE  four roundings of the mean.
TEST(Render, AveragesTheSamplesOfAPixel) {
  proves({"IU.5.8.1"}, Oracle::closed_form, "samples inside a corner, counted");
  constexpr int kSide = 5;
  for (const Vec2& edge : {Vec2(0.33, 0.8125), Vec2(0.53, 0.12), Vec2(0.647, 0.355), Vec2(0.791, 0.57)}) {
    for (const int n : {1, 2, 3, 4}) {
      const Rendering rendering = rendered(corner(edge.x(), edge.y(), kSide), n);
      const auto covered = [&](int pixel, double limit) {
        int count = 0;
        for (int a = 0; a < n; ++a) count += (pixel + (a + 0.5) / n) / kSide < limit ? 1 : 0;
        return count;
      };
      for (int j = 0; j < kSide; ++j) {
        for (int column = 0; column < kSide; ++column) {
          const double expected = static_cast<double>(covered(column, edge.x()) * covered(j, edge.y())) / (n * n);
          const double found = rendering.image.at(column, kSide - 1 - j)[0];
          EXPECT_TRUE(near(found, expected, 4 * kUnitRoundoff)) << edge.transpose() << " " << n;
        }
      }
      EXPECT_EQ(rendering.counts.eye_rays, static_cast<std::uint64_t>(kSide * kSide * n * n));
    }
  }
}

// CLAIM      A rendering that is stopped says so, keeps the rows that are done as they would be, and leaves the others black.
// ORACLE     metamorphic: the complete picture.
// TOLERANCE  none: all bits.
TEST(Render, KeepsTheRowsThatAreDone) {
  proves({}, Oracle::metamorphic, "the complete picture");
  const Scene scene = corner(2, 2, 20);  // the whole picture is bright
  const Image whole = rendered(scene, 1).image;
  std::atomic<bool> stop{false};
  Execution execution;
  execution.threads = 1;
  execution.stop = &stop;
  execution.progress = [&](std::size_t done, std::size_t) { stop = done >= 7; };
  const Rendering part = rendered(scene, 1, execution);
  EXPECT_FALSE(part.complete);
  std::size_t rows = 0;
  std::uint64_t wrong = 0;
  for (int row = 0; row < 20; ++row) {
    const bool done = part.row_done[static_cast<std::size_t>(row)] != 0;
    if (done) ++rows;
    for (int column = 0; column < 20; ++column) {
      const Rgb expected = done ? whole.at(column, row) : Rgb(0, 0, 0);
      if ((part.image.at(column, row) != expected).any()) ++wrong;
    }
  }
  EXPECT_EQ(rows, 7u);
  EXPECT_TRUE(all_agree(wrong, 400));
  EXPECT_EQ(whole.at(3, 3)[0], 1);
}

// CLAIM      Rays that are not followed are counted by reason, with their weight: between two mirrors of k_r, a depth D leaves out one
//            ray of weight k_r^(D+1).
// ORACLE     closed form: k_r^(D+1).
// TOLERANCE  one rounding a level.
TEST(Render, ReportsWhatWasLeftOut) {
  proves({"IU.5.5"}, Oracle::closed_form, "k_r^(D+1) between two parallel mirrors");
  Scene scene;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, specular(0.5, 0));
  add(scene, Plane{{0, 0, 2}, {0, 0, -1}}, specular(0.5, 0));
  scene.camera = corner(2, 2, 4).camera;
  const auto accelerator = make_accelerator(scene, AcceleratorKind::brute_force);
  RenderOptions options;
  options.limits.depth = 6;
  const RenderCounts deep = render(*accelerator, options, {}).value().counts;
  EXPECT_EQ(deep.cut_by_depth, 16u);
  EXPECT_EQ(deep.cut_by_cutoff, 0u);
  EXPECT_EQ(deep.reflected_rays, 16u * 6);
  EXPECT_TRUE(near(deep.largest_cut_weight, 0x1p-7, 7 * 0x1p-60));
  options.limits.cutoff = 0.1;  // 0.125 is followed, 0.0625 is not
  const RenderCounts cut = render(*accelerator, options, {}).value().counts;
  EXPECT_EQ(cut.cut_by_cutoff, 16u);
  EXPECT_EQ(cut.cut_by_depth, 0u);
  EXPECT_EQ(cut.reflected_rays, 16u * 3);

  options.limits.depth = -1;
  EXPECT_EQ(render(*accelerator, options, {}).error().code, ErrorCode::usage);
  options.limits.depth = 1;
  options.sampling.samples_per_side = 0;
  EXPECT_EQ(render(*accelerator, options, {}).error().code, ErrorCode::usage);
}

/// A shining half-plane with a slanted edge, a mirror and a lamp: enough for edges, trees and shadows.
Scene slanted() {
  Scene scene = corner(2, 2, 26);
  scene.camera.rows = 23;
  scene.objects.clear();
  Material lit = diffuse(0.7);
  add(scene, Polygon::make({{-9, -9, 0}, {0.3, -9, 0}, {0.8, 9, 0}, {-9, 9, 0}}).value(), lit);
  add(scene, Plane{{0, 0, -1}, {0, 0, 1}}, specular(0.5, 0));
  add(scene, Sphere{{0.4, 0.6, 0.1}, 0.12}, diffuse(0.3));
  scene.lights.push_back(PointLight{{1, 1, 2}, Rgb(1, 0.8, 0.6)});
  scene.background = Rgb(0.1, 0.2, 0.3);
  return scene;
}

/// One of each scheme, with filters of each width.
std::vector<RenderOptions> every_way() {
  std::vector<RenderOptions> all;
  for (const SamplingScheme scheme : {SamplingScheme::uniform, SamplingScheme::jittered, SamplingScheme::adaptive,
                                      SamplingScheme::adaptive_jittered}) {
    for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian, FilterKind::mitchell}) {
      RenderOptions options;
      options.sampling.scheme = scheme;
      options.sampling.samples_per_side = 4;
      options.sampling.seed = 3;
      options.filter = usual_filter(kind);
      options.facts = {PictureFact::samples, PictureFact::object};
      all.push_back(options);
    }
  }
  return all;
}

std::uint64_t different(const Image& a, const Image& b) {
  std::uint64_t count = a.pixels.size() == b.pixels.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.pixels.size() && count == 0; ++i) {
    if ((a.pixels[i] != b.pixels[i]).any()) ++count;
  }
  return count;
}

// CLAIM      IU.5.8.1, IU.5.8.2: every way of sampling gives the same bits and counts with one thread and with three, and in any part
//            of the picture the bits of the whole.
// ORACLE     metamorphic: one thread, the whole picture.
// TOLERANCE  none: all bits.
TEST(Render, HasTheSameBitsInPartsAndWithThreads) {
  proves({"IU.5.8.1", "IU.5.8.2"}, Oracle::metamorphic, "one thread, the whole picture");
  uses_seed(3);
  const Scene scene = slanted();
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  std::uint64_t wrong = 0, compared = 0;
  for (RenderOptions options : every_way()) {
    Execution one, three;
    one.threads = 1;
    three.threads = 3;
    const Rendering whole = render(*accelerator, options, one).value();
    const Rendering other = render(*accelerator, options, three).value();
    wrong += different(whole.image, other.image) + different(whole.facts[0], other.facts[0]);
    EXPECT_EQ(whole.counts.rays(), other.counts.rays());
    for (const PixelWindow& window : {PixelWindow{0, 0, 5, 3}, PixelWindow{7, 9, 8, 10}, PixelWindow{11, 4, 26, 23}}) {
      options.crop = window;
      const Rendering part = render(*accelerator, options, three).value();
      Image expected(window.columns(), window.rows());
      for (int row = window.top; row < window.bottom; ++row) {
        for (int column = window.left; column < window.right; ++column)
          expected.at(column - window.left, row - window.top) = whole.image.at(column, row);
      }
      wrong += different(part.image, expected);
      ++compared;
    }
    compared += 2;
  }
  EXPECT_TRUE(all_agree(wrong, compared));
}

// CLAIM      A rendering that was stopped, however often, and resumed ends with the bits and the counts of one that was not.
// ORACLE     metamorphic: the rendering that was not stopped.
// TOLERANCE  none: all bits.
TEST(Render, ResumesToTheSameBits) {
  proves({}, Oracle::metamorphic, "the rendering that was not stopped");
  const Scene scene = slanted();
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  std::uint64_t wrong = 0, compared = 0;
  for (const RenderOptions& options : every_way()) {
    const Rendering whole = render(*accelerator, options, {}).value();
    Rendering before;
    RenderSession session;
    int runs = 0;
    for (bool complete = false; !complete && runs < 20; ++runs) {
      std::atomic<bool> stop{false};
      Execution execution;
      execution.threads = 2;
      execution.stop = &stop;
      execution.progress = [&](std::size_t done, std::size_t) { stop = done >= 7; };
      Rendering now = render(*accelerator, options, execution, session).value();
      complete = now.complete;
      before = std::move(now);
      session.before = &before;
    }
    EXPECT_GT(runs, 2);
    wrong += different(before.image, whole.image) + different(before.facts[0], whole.facts[0]) +
             different(before.facts[1], whole.facts[1]);
    compared += 3;
    EXPECT_EQ(before.counts.eye_rays, whole.counts.eye_rays);
    EXPECT_EQ(before.counts.shadow_rays, whole.counts.shadow_rays);
    EXPECT_EQ(before.counts.tests.volumes, whole.counts.tests.volumes);
  }
  EXPECT_TRUE(all_agree(wrong, compared));
}

// CLAIM      Facts of a pixel: the distance along the ray through its centre, normal, k_d and index of what it meets there; samples and depth
//            of the trees: without a filter across pixels, the samples of uniform sampling are N².
// ORACLE     closed form: a plane at height ½ below the eye, seen at 45 degrees at the picture's edges: ½ √(1 + x² + y²).
// TOLERANCE  distance: the direction's 200 roundings (validation/raytracing/camera_rays_test.cpp) and t's; others none.
TEST(Render, TellsFactsOfPixels) {
  proves({}, Oracle::closed_form, "distances to a plane");
  Scene scene = corner(0.5, 2, 8);
  scene.materials[0].k_d = Rgb(0.1, 0.2, 0.3);
  const auto accelerator = make_accelerator(scene, AcceleratorKind::brute_force);
  RenderOptions options;
  options.sampling.samples_per_side = 3;
  options.facts = {PictureFact::depth,  PictureFact::normal,  PictureFact::albedo,
                   PictureFact::object, PictureFact::samples, PictureFact::tree_depth};
  const Rendering rendering = render(*accelerator, options, {}).value();
  ASSERT_EQ(rendering.facts.size(), 6u);
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      const double x = (2 * column + 1) / 8.0 - 1, y = (2 * row + 1) / 8.0 - 1;
      const bool meets = column < 4;
      EXPECT_TRUE(near(rendering.facts[0].at(column, row)[0], meets ? 0.5 * std::sqrt(1 + x * x + y * y) : 0,
                       400 * kUnitRoundoff));
      EXPECT_EQ(rendering.facts[1].at(column, row)[2], meets ? 1 : 0);
      EXPECT_EQ(rendering.facts[2].at(column, row)[1], meets ? 0.2 : 0);
      EXPECT_EQ(rendering.facts[3].at(column, row)[0], meets ? 0 : -1);
      EXPECT_EQ(rendering.facts[4].at(column, row)[0], 9);
      EXPECT_EQ(rendering.facts[5].at(column, row)[0], 0);
    }
  }
}

// CLAIM      A preview has one colour a square, that of the ray through its centre; squares at the edge are cut, and have the centre of what is left.
// ORACLE     exact: a 10 × 10 picture of a bright corner; which squares of 4 have their centres in it.
// TOLERANCE  none.
TEST(Preview, LooksThroughTheCentresOfItsSquares) {
  proves({}, Oracle::exact, "centres of squares, by hand");
  // Bright are x < 0.55 and y < 0.55. The centres of the squares: 0.2, 0.6, 0.9 across, and 0.8, 0.4, 0.1 up, from the top.
  const Scene scene = corner(0.55, 0.55, 10);
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  RenderOptions options;
  const auto whole = preview(*accelerator, options, 4, {});
  ASSERT_TRUE(whole.ok() && whole.value());
  options.crop = PixelWindow{3, 2, 9, 10};
  const auto part = preview(*accelerator, options, 4, {});
  ASSERT_TRUE(part.ok() && part.value());
  std::uint64_t wrong = 0;
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 10; ++column) {
      const double expected = column < 4 && row >= 4 ? 1 : 0;
      if ((whole.value()->at(column, row) != expected).any()) ++wrong;
      if (column >= 3 && column < 9 && row >= 2 && (part.value()->at(column - 3, row - 2) != expected).any()) ++wrong;
    }
  }
  EXPECT_TRUE(all_agree(wrong, 148));
}

}  // namespace
}  // namespace etendue::validation
