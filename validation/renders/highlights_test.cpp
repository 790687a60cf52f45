// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/scene_reader.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/single_samples.hpp"

// scenes/highlights: Phong's, Blinn's and the facets' highlights, by both methods.
namespace etendue::validation {
namespace {

Scene scene_named(const char* file) {
  Scene scene = read_scene(source_root() / "scenes/highlights" / file).value().scene;
  scene.camera.columns /= 2;
  scene.camera.rows /= 2;
  return scene;
}

/// The brightest pixel of an object.
Rgb brightest(const Rendering& picture, std::size_t object) {
  Rgb best = Rgb::Zero();
  for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
    if (picture.facts[0].pixels[i][0] != static_cast<double>(object)) continue;
    if (picture.image.pixels[i].sum() > best.sum()) best = picture.image.pixels[i];
  }
  return best;
}

// CLAIM      IU.4.2.2, IU.2.7.1: rays and rasteriser show the three laws alike, lit from the viewer's side and from behind.
// ORACLE     another method: the ray tracer at the same pixels.
// TOLERANCE  a net of 512 facets has normals within 1e-4 of the ball's where they are interpolated; the steepest law changes by less than
//            100 times that, and more where n_v is small: 0.02 in all but 2 % of the balls' pixels, which lie at the outline.
TEST(Highlights, LookTheSameByBothMethods) {
  proves({"IU.4.2.2", "IU.2.7.1"}, Oracle::program, "the ray tracer at the same pixels");
  for (const char* file : {"scene.json", "grazing.json"}) {
    const Scene scene = scene_named(file);
    const Rendering rays = traced_once(scene);
    const Image drawn = drawn_once(scene, 512);
    std::uint64_t balls = 0, unlike = 0;
    for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
      if (rays.facts[0].pixels[i][0] < 0) continue;
      ++balls;
      unlike += (rays.image.pixels[i] - drawn.pixels[i]).abs().maxCoeff() > 0.02 ? 1u : 0u;
    }
    EXPECT_TRUE(holds(balls > 5000 && unlike * 50 <= balls)) << file << ": " << unlike << " of " << balls;
  }
}

// CLAIM      IU.4.2.3: near the normal the facets' highlight is like Phong's and Blinn's, but has the metal's colour; where light grazes it is
//            several times as bright as theirs, and paler.
// ORACLE     closed form: the peak, 0.15 F/(4 m²) = 0.6 F at normal incidence beside 0.3 of the lobes; red over blue is that of F, from
//            the metal's complex indices by a script: 1.809 at 11.5°, 1.529 at 75.6°, half way between light and viewer.
// TOLERANCE  viewers' directions differ by 3.4° across the picture, θ by 1.7°, F's ratio by 0.029 a degree at 75.6° and by less than
//            0.01 in all at 11.5°. Peaks of the lobes: a pixel beside the peak loses less than 1 %.
TEST(Highlights, DifferAtGrazingIncidence) {
  proves({"IU.4.2.3"}, Oracle::closed_form, "peaks of the three laws, and Fresnel's factor");
  const Scene near_by = scene_named("scene.json"), grazing = scene_named("grazing.json");
  const auto peak = [](const Scene& scene, std::size_t object) -> Rgb {
    Scene shiny = scene;
    for (Material& material : shiny.materials) material.k_d = material.k_a = Rgb::Zero();
    return brightest(traced_once(shiny), object);
  };
  const Rgb phong = peak(near_by, 0), blinn = peak(near_by, 1), facets = peak(near_by, 2);
  EXPECT_TRUE(near(phong[1], 0.3, 0.003));
  EXPECT_TRUE(near(blinn[1], 0.3, 0.003));
  EXPECT_TRUE(holds(facets[1] > 0.9 * phong[1] && facets[1] < 2 * phong[1])) << facets.transpose();
  EXPECT_TRUE(near(facets[0] / facets[2], 1.809, 0.01)) << facets.transpose();
  const Rgb far_phong = peak(grazing, 0), far_facets = peak(grazing, 2);
  EXPECT_TRUE(holds(far_facets[1] > 3 * far_phong[1])) << far_facets.transpose() << " and " << far_phong.transpose();
  EXPECT_TRUE(near(far_facets[0] / far_facets[2], 1.529, 0.05)) << far_facets.transpose();
}

}  // namespace
}  // namespace etendue::validation
