// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>
#include <random>

#include "etendue/raster/gouraud.hpp"
#include "etendue/view/shaded_view.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

// Interpolation along rows by one addition a pixel, in whole pictures.
namespace etendue::validation {
namespace {

/// A ball, a box and a square, seen from near: triangles are many pixels wide, the square's farthest corner lies 4.6 times as deep as
/// its nearest.
Scene still_life() {
  Scene scene;
  Material gloss = diffuse(0.5);
  gloss.k_s = 0.5;
  gloss.phong_exponent = 20;
  add(scene, Sphere{{0, 3, 0}, 1}, gloss, "ball");
  add(scene, Box{{1.5, 4, 0}, Mat3::Identity(), {0.5, 1, 2}}, gloss, "box");
  add(scene, square({0, 4, -1}, Vec3::UnitZ(), 2.5), diffuse(0.8), "floor");
  scene.camera.eye = {0.4, 0.2, 0.3};
  scene.camera.gaze = {0, 1, -0.1};
  scene.camera.horizontal_half_angle = 0.6;
  scene.camera.columns = 150;
  scene.camera.rows = 90;
  scene.ambient = Rgb::Constant(0.2);
  scene.lights = {PointLight{{-2, 0, 3}, {0.7, 0.6, 0.5}}, DirectionalLight{Vec3(1, -2, 2) / 3, {0.3, 0.4, 0.5}}};
  return scene;
}

Image drawn(const Scene& scene, Shading shading, Stepping stepping) {
  ShadingOptions options;
  options.shading = shading;
  options.stepping = stepping;
  options.net.facets = 12;
  return view_shaded(scene, options).value().image;
}

// CLAIM      IU.3.2c, IU.3.3, IU.3.4: pictures whose weights of the corners come by one addition a pixel have the bits of the formula on the same
//            multiples, made of intensities, normals or products; and are the pictures by the plain formula but for the rounding to multiples.
// ORACLE     identity: the same picture stepped in both ways, and directly.
// TOLERANCE  none for the bits. To the plain formula a weight errs by δ, the two bounds for rows of 300 samples times 5 for the depths' ratio. With
//            |N| ≥ 0.9, the eye above 1.2 and the light above 2 away and corners within 6.5, N moves by 3.4 δ, V by 17 δ, L by 10 δ, so R·V by
//            51 δ, and a light of 0.7 adds 0.7 (0.5 · 20 · 51 + 0.5 · 14) δ < 400 δ; there are two.
TEST(Stepping, DrawsTheSamePictures) {
  proves({"IU.3.2c", "IU.3.3", "IU.3.4"}, Oracle::identity,
         "whole pictures by additions and by the formula, bit by bit");
  const Scene scene = still_life();
  std::uint64_t wrong = 0, rounded = 0;
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong, Shading::dot}) {
    const Image stepped = drawn(scene, shading, Stepping::incremental);
    const Image formula = drawn(scene, shading, Stepping::direct_on_multiples);
    const Image plain = drawn(scene, shading, Stepping::direct);
    double worst = 0;
    for (std::size_t i = 0; i < stepped.pixels.size(); ++i) {
      wrong += (stepped.pixels[i] != formula.pixels[i]).any();
      rounded += (stepped.pixels[i] != plain.pixels[i]).any();
      worst = std::max(worst, (stepped.pixels[i] - plain.pixels[i]).abs().maxCoeff());
    }
    EXPECT_TRUE(within(worst, 2 * 400 * 5 * (stepping_error(300) + kInterpolationError)));
  }
  EXPECT_GT(rounded, 1000u) << "the multiples are not the plain numbers";
  EXPECT_TRUE(all_agree(wrong, std::size_t{4} * 150 * 90));
}

// CLAIM      IU.3.3: normals too: n along the edges, n_Q = u n_B + (1 − u) n_A, along the row by additions, and made a unit vector at each pixel,
//            is the interpolated normal, and lies in the plane of the ends of its row.
// ORACLE     closed form: the text's three interpolations in long double, normalised.
// TOLERANCE  stepping_error() of the row, and 16 u for those of the unit vector, over the length of the interpolated normal, at least 1/2.
TEST(Stepping, TurnsNormalsByAdditions) {
  proves({"IU.3.3", "IU.3.2c"}, Oracle::closed_form, "the text's steps along edges and row in long double");
  using Long = Eigen::Matrix<long double, 3, 1>;
  constexpr int kColumns = 200, kRows = 120;
  std::mt19937_64 random(3031);
  const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::uint64_t compared = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::array<GouraudVertex, 3> t;
    const std::array<Vec2, 3> about{Vec2(5, 5), Vec2(30, 110), Vec2(190, 70)};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 normal = Vec3(share() - 0.5, share() - 0.5, 1).normalized();
      const Vec2 moved = about[k] + 4 * Vec2(share(), share());
      t[k] = {(moved * 4096).array().round() / 4096, 1, normal.array()};
    }
    DepthRaster raster(kColumns, kRows, Eigen::Array3d::Zero(), Stepping::incremental);
    raster.draw(t);
    const auto along = [&](std::size_t a, std::size_t b, double row) {  // (column, normal) of an edge at a row
      const long double y = row, from = t[a].position.y(), u = (y - from) / (t[b].position.y() - from);
      const long double x = u * t[b].position.x() + (1 - u) * t[a].position.x();
      return std::pair<long double, Long>(
          x, u * t[b].value.matrix().cast<long double>() + (1 - u) * t[a].value.matrix().cast<long double>());
    };
    for (int row = 0; row < kRows; ++row) {
      const double y = row + 0.5;
      for (int column = 0; column < kColumns; ++column) {
        const Vec3 shown = raster.picture().at(column, row).matrix();
        if (shown.isZero(0)) continue;
        const auto left = along(0, 1, y), right = y < t[2].position.y() ? along(0, 2, y) : along(1, 2, y);
        const long double v = (column + 0.5L - left.first) / (right.first - left.first);
        const Long formula = (v * right.second + (1 - v) * left.second).normalized();
        const double error = static_cast<double>((shown.normalized().cast<long double>() - formula).norm());
        EXPECT_TRUE(within(error, 2 * (std::sqrt(3.0) * stepping_error(kColumns) + 16 * 0x1p-53)));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 100000u);
}

}  // namespace
}  // namespace etendue::validation
