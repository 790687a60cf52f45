// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/view/shaded_view.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.3.3: an infinite plane is drawn by rasteriser as rays see it, to the horizon, from 10⁻⁷ above it and from 10⁶, from below, and hides a large thing behind it.
// ORACLE     program: the ray tracer.
// TOLERANCE  corners are rounded to 1/4096 pixel, which moves what is between them by at most √2/8192: 2^-12 of the largest change to a neighbouring pixel;
//            2^-28 for points to 2^-31 of the height (plane_before()). None for what is sky.
TEST(ShadedView, ShowsPlanesFromAnyHeight) {
  proves({"IU.3.3"}, Oracle::program, "the ray tracer, four heights");
  constexpr double kSky = 5;
  for (const double height : {1e-7, 1.0, 1e6, -3.0}) {
    Scene scene;
    Material floor = diffuse(0.5);
    floor.k_s = 0.3;
    floor.phong_exponent = 3;
    add(scene, Plane{{2, 1, 0}, {0, 0, 1}}, floor, "floor");
    const double size = std::abs(height);
    const Vec3 below(0, 5, -height);
    add(scene, Triangle{below, below + Vec3(1e4, 0, 0), below + Vec3(0, 1e4, 0)}, diffuse(0.8), "cellar");
    scene.ambient = {0.2, 0.2, 0.2};
    scene.background = {kSky, kSky, kSky};
    scene.lights = {PointLight{{size, size, 2 * height}, {0.6, 0.5, 0.4}},
                    DirectionalLight{Vec3(2, -1, 2 * height / size) / 3, {0.3, 0.3, 0.3}}};
    scene.camera.eye = {0.1 * size, 0, height};
    scene.camera.gaze = {0, 1, -0.3 * height / size};
    scene.camera.horizontal_half_angle = 0.5;
    scene.camera.columns = 60;
    scene.camera.rows = 50;
    ShadingOptions shading;
    shading.samples = 1;
    const Image drawn = view_shaded(scene, shading).value().image;
    RenderOptions rays;
    rays.sampling.scheme = SamplingScheme::uniform;
    rays.sampling.samples_per_side = 1;
    rays.filter.radius = 0.5;
    const Image traced = render(*make_accelerator(scene, AcceleratorKind::bounding_volumes), rays, {}).value().image;
    std::uint64_t sky = 0, ground = 0, wrong = 0;
    for (int row = 1; row < 49; ++row) {
      for (int column = 1; column < 59; ++column) {
        const Rgb expected = traced.at(column, row), shown = drawn.at(column, row);
        const auto is_sky = [](const Rgb& pixel) { return pixel[0] == kSky; };
        wrong += is_sky(expected) != is_sky(shown);
        if (is_sky(expected) || is_sky(shown)) {
          ++sky;
          continue;
        }
        double change = 0;
        for (int k = 0; k < 9; ++k) {
          const Rgb beside = traced.at(column + k % 3 - 1, row + k / 3 - 1);
          if (!is_sky(beside)) change = std::max(change, (beside - expected).abs().maxCoeff());
        }
        ++ground;
        EXPECT_TRUE(within((shown - expected).abs().maxCoeff(), 0x1p-12 * change + 0x1p-28))
            << height << ": " << column << ' ' << row;
      }
    }
    EXPECT_TRUE(all_agree(wrong, sky + ground));
    EXPECT_TRUE(holds(sky > 300 && ground > 1500));
  }
}

}  // namespace
}  // namespace etendue::validation
