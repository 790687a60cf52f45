// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/frost.hpp"

#include <array>
#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/raytracing/render.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

// What frosted glass does: it sends on as much light as clear glass, in directions about those of clear glass.
namespace etendue::validation {
namespace {

constexpr double kSigmas = 5;

Material frosted_glass(double k_t, double eta, double frost) {
  Material material = specular(0, k_t, eta);
  material.frost = frost;
  return material;
}

// CLAIM      IU.4.3d: of the directions behind a frosted surface the mean of cos α from the clear one T is 1 − f where none is turned over (T along
//            N), the mean direction then is (1 − f) T; for any T the mean along the surface is (1 − f) of T's; all are unit vectors and lie on T's
//            side; without frost T itself comes back.
// ORACLE     closed form: moments of cos^m about an axis, m + 1 = (1 − f)/f: what is turned over keeps its part along the surface.
// TOLERANCE  statistics: 40,000 directions, components of variance below 1: 5/200. Unit length to 4 u.
TEST(Frost, ScattersAboutTheClearDirection) {
  proves({"IU.4.3d"}, Oracle::closed_form, "moments of a power of the cosine");
  CounterRandom random(43);
  uses_seed(43);
  constexpr int kCount = 40'000;
  for (const double frost : {0.0, 0.01, 0.1, 0.3, 0.5}) {
    for (const double tilt : {0.0, 0.5, 1.2, 1.5}) {
      const Vec3 turned = Vec3(random.between(-1, 1), 0.3, 0.2).normalized();
      const Vec3 normal = turned, tangent = turned.unitOrthogonal();
      const Vec3 clear = -std::cos(tilt) * normal + std::sin(tilt) * tangent;  // the normal is on the side of incidence
      Vec3 sum = Vec3::Zero();
      std::uint64_t wrong = 0;
      for (int i = 0; i < kCount; ++i) {
        const double a = random.unit(), b = random.unit();
        const Vec3 direction = frosted(clear, normal, frost, a, b);
        if (frost == 0 && direction != clear) ++wrong;
        if (direction.dot(normal) * clear.dot(normal) < 0 || std::abs(direction.norm() - 1) > 4 * kUnitRoundoff)
          ++wrong;
        sum += direction;
      }
      EXPECT_TRUE(all_agree(wrong, kCount));
      const Vec3 mean = sum / kCount, expected = (1 - frost) * clear;
      const double bound = kSigmas / std::sqrt(static_cast<double>(kCount));
      const auto along = [&](const Vec3& v) -> Vec3 { return v - v.dot(normal) * normal; };
      EXPECT_TRUE(within((along(mean) - along(expected)).norm(), bound)) << frost << " " << tilt;
      if (tilt == 0) {
        EXPECT_TRUE(within((mean - expected).norm(), bound)) << frost;
      }
    }
  }
}

// CLAIM      IU.4.3d: frosted glass loses nothing: a body of it in light that is the same from everywhere shows k_t of that for each surface, as clear
//            glass does, whatever its frost, index and form.
// ORACLE     identity: every path through two surfaces brings k_t² of the background.
// TOLERANCE  eight roundings; only paths that leave after two surfaces are compared, which is all of a pane's.
TEST(Frost, KeepsTheLight) {
  proves({"IU.4.3d"}, Oracle::identity, "light that is the same from everywhere");
  for (const double frost : {0.0, 0.05, 0.5}) {
    Scene scene;
    scene.background = Rgb(0.5, 1, 2);
    add(scene, square({0, 0, 2}, {0.3, 0, -1}, 40), frosted_glass(0.75, 1, frost));
    add(scene, square({0, 0, 4}, {0.3, 0, 1}, 4000), frosted_glass(0.75, 1, frost));
    const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
    int followed = 0;
    for (int i = 0; i < 200; ++i) {
      const Ray ray{Vec3(0, 0, 0), Vec3(0.001 * i, -0.0007 * i, 1).normalized()};
      const RayTree tree = trace(ray, *accelerator, {12, 0}, {{}, 0, sample_key(7, i, 0, 0)});
      if (tree.nodes.size() != 3) continue;
      ++followed;
      EXPECT_TRUE(near(shade(tree, *accelerator).colour[1], 0.75 * 0.75, 8 * kUnitRoundoff));
    }
    EXPECT_GT(followed, 120);
  }
}

// CLAIM      IU.4.3d: through a frosted pane a bright disc is a glow: straight before it, with the angle β of the disc's radius as seen from
//            the pane, the share 1 − (cos β)^((1 − f)/f) of its light; through a clear one the disc itself.
// ORACLE     closed form: the integral of p(α) up to β.
// TOLERANCE  statistics: 64 × 64 samples of a yes or no, 5 σ of at most ½/64; the pixel moves β by less than 1e-3, and the share by 3e-3 at most.
TEST(Frost, BlursWhatLiesBehindAPane) {
  proves({"IU.4.3d"}, Oracle::closed_form, "the lobe's integral over a disc");
  Material bright;
  bright.emission = Rgb::Ones();
  for (const double frost : {0.0, 0.02, 0.2, 0.5}) {
    for (const double radius : {0.25, 1.0, 3.0}) {
      Scene scene;
      add(scene, square({0, 0, 2}, {0, 0, -1}, 50), frosted_glass(1, 1, frost));
      add(scene, Disc{{0, 0, 4}, {0, 0, -1}, radius}, bright);
      scene.camera.gaze = Vec3::UnitZ();
      scene.camera.up = Vec3::UnitY();
      scene.camera.horizontal_half_angle = 1e-4;
      scene.camera.columns = scene.camera.rows = 1;
      RenderOptions options;
      options.sampling.scheme = SamplingScheme::jittered;
      options.sampling.samples_per_side = 64;
      const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
      const double found = render(*accelerator, options, {}).value().image.at(0, 0)[0];
      const double cosine = 2 / std::hypot(2, radius);
      const double expected = frost == 0 ? 1 : 1 - std::pow(cosine, (1 - frost) / frost);
      EXPECT_TRUE(near(found, expected, kSigmas * 0.5 / 64 + 3e-3)) << frost << " " << radius;
    }
  }
}

// CLAIM      IU.4.3d, IU.5.7: frosted glass has the same bits with any accelerator and number of threads, and in a part of the picture.
// ORACLE     metamorphic: brute force, one thread, the whole picture.
// TOLERANCE  none: all bits.
TEST(Frost, HasTheSameBitsHoweverItIsFound) {
  proves({"IU.4.3d", "IU.5.7"}, Oracle::metamorphic, "brute force, one thread");
  Scene scene;
  scene.background = Rgb(0.2, 0.3, 0.4);
  add(scene, Sphere{{0, 0, 4}, 1}, frosted_glass(0.9, 1.5, 0.05));
  for (int i = 0; i < 6; ++i)
    add(scene, Box{{i - 3.0, 0.5 * i - 1, 7}, Mat3::Identity(), {0.3, 0.4, 0.3}}, diffuse(0.5));
  scene.lights.push_back(PointLight{{3, 3, 0}, Rgb::Ones()});
  scene.camera.gaze = Vec3::UnitZ();
  scene.camera.up = Vec3::UnitY();
  scene.camera.columns = scene.camera.rows = 24;
  RenderOptions options;
  options.sampling.scheme = SamplingScheme::jittered;
  options.sampling.samples_per_side = 2;
  Execution one, three;
  one.threads = 1;
  three.threads = 3;
  const Image reference = render(*make_accelerator(scene, AcceleratorKind::brute_force), options, one).value().image;
  options.crop = PixelWindow{5, 6, 20, 19};
  std::uint64_t wrong = 0, compared = 0;
  for (const AcceleratorKind kind : {AcceleratorKind::bounding_volumes, AcceleratorKind::bounding_spheres,
                                     AcceleratorKind::grid, AcceleratorKind::octree}) {
    const Image other = render(*make_accelerator(scene, kind), options, three).value().image;
    for (int row = 0; row < 13; ++row) {
      for (int column = 0; column < 15; ++column, ++compared)
        wrong += (other.at(column, row) != reference.at(column + 5, row + 6)).any() ? 1u : 0u;
    }
  }
  EXPECT_TRUE(all_agree(wrong, compared));
}

}  // namespace
}  // namespace etendue::validation
