// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>
#include <utility>

#include "etendue/io/scene_reader.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/scene_builder.hpp"
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

/// The middle ball alone, lit from behind, with one material.
Rendering middle_ball(double k_d, double k_s, std::optional<Highlight> highlight) {
  Scene scene = scene_named("weights.json");
  scene.lights.erase(scene.lights.begin());
  std::swap(scene.objects[0], scene.objects[1]);
  scene.objects.resize(1);
  Material material = diffuse(k_d);
  material.k_a = Rgb::Zero();
  material.k_s = k_s;
  material.phong_exponent = 32;
  material.highlight = std::move(highlight);
  scene.materials.assign(1, material);
  scene.objects[0].material = 0;
  return traced_once(scene);
}

// CLAIM      IU.2.7.1: W(θ) weighs Phong's lobe: with Fresnel's factor the light from behind is mirrored 2.9 times as strongly as
//            with the constant that suits light from the front.
// ORACLE     closed form: the same ball's lobe with W = 1, times Fresnel's formulas with sines and tangents of the angles, whose cos θ is
//            what the ball shows with a matt material. Where the lobe peaks θ is 75.6°, and Fresnel's factor 0.320.
// TOLERANCE  3e-13: two dozen roundings, and θ's, by which tangents near 90° magnify it 100 times at most: pixels with cos θ > 0.01.
TEST(Highlights, AreWeighedByTheAngleOfIncidence) {
  proves({"IU.2.7.1"}, Oracle::closed_form, "Fresnel's sine and tangent formulas times the lobe, pixel by pixel");
  const Scene scene = scene_named("weights.json");
  const Material& glass = scene.materials[scene.objects[1].material];
  const Rendering cosines = middle_ball(1, 0, {}), lobe = middle_ball(0, 1, {}),
                  weighed = middle_ball(0, glass.k_s, glass.highlight);
  double brightest = 0, constant = 0;
  for (std::size_t i = 0; i < lobe.image.pixels.size(); ++i) {
    const double cosine = cosines.image.pixels[i][0] / 0.8;  // of the light's intensity
    if (cosines.facts[0].pixels[i][0] < 0 || cosine <= 0.01) continue;
    const double in = std::acos(cosine), out = std::asin(std::sin(in) / 2);
    const double s = std::sin(in - out) / std::sin(in + out), p = std::tan(in - out) / std::tan(in + out);
    const double weight = (s * s + p * p) / 2;
    EXPECT_TRUE(near(weighed.image.pixels[i][0], weight * lobe.image.pixels[i][0], 3e-13));
    brightest = std::max(brightest, weighed.image.pixels[i][0]);
    constant = std::max(constant, 0.111 * lobe.image.pixels[i][0]);
  }
  EXPECT_TRUE(holds(brightest > 2.8 * constant && brightest < 3.2 * constant)) << brightest << " beside " << constant;
}

}  // namespace
}  // namespace etendue::validation
