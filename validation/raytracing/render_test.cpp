// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/render.hpp"

#include <atomic>
#include <cmath>

#include "etendue/core/rounding.hpp"
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
  options.samples_per_side = samples;
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
  options.samples_per_side = 0;
  EXPECT_EQ(render(*accelerator, options, {}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace etendue::validation
