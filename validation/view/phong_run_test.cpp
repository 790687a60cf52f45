// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/phong_run.hpp"

#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

Vec3 somewhere(CounterRandom& random) {
  return {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
}

/// Lights of all four kinds over two materials, one of them checkered.
Scene lit_scene() {
  Scene scene;
  Material gloss = diffuse(0.5);
  gloss.k_s = 0.4;
  gloss.phong_exponent = 7;
  gloss.emission = {0.1, 0, 0.2};
  Material checkered = gloss;
  checkered.phong_exponent = 30;
  checkered.pattern = MaterialPattern{Checkerboard{}, {0.1, 0.2, 0.3}, {0.3, 0.2, 0.1}};
  add(scene, Sphere{{0, 0, 0}, 1}, gloss);
  add(scene, Sphere{{0, 0, 0}, 1}, checkered);
  scene.ambient = {0.1, 0.2, 0.3};
  scene.camera.eye = {0.5, 4, 0.25};
  scene.camera.gaze = {0.2, -1, 0};
  scene.lights = {DirectionalLight{Vec3(1, 2, 2) / 3, {0.7, 0.6, 0.5}},
                  PointLight{{1, 3, 2}, {0.4, 0.5, 0.6}, {Falloff::Law::inverse_square, 2, 0}},
                  RectangleLight{{-1, 3, -1}, {1, 0, 0}, {0, 0, 1}, {0.3, 0.3, 0.2}},
                  SphereLight{{0, -4, 1}, 0.5, {0.2, 0.1, 0.4}}};
  return scene;
}

Facet random_facet(CounterRandom& random) {
  Facet facet{random.below(2), {}, {}, somewhere(random).normalized()};
  for (std::size_t k = 0; k < 3; ++k) {
    facet.corners[k] = somewhere(random);
    facet.normals[k] = somewhere(random).normalized();
  }
  return facet;
}

/// Facets at whose first corner something is not defined: opposite normals that cancel, a light, the eye.
std::vector<Facet> degenerate(const Scene& scene, CounterRandom& random) {
  std::vector<Facet> facets(3, random_facet(random));
  facets[0].normals[0].setZero();
  facets[1].corners[0] = std::get<PointLight>(scene.lights[1]).position;
  facets[2].corners[0] = scene.camera.eye;
  return facets;
}

std::size_t differing(const FacetShader& shader, const std::vector<Facet>& facets,
                      const std::vector<Eigen::Array3d>& weights, std::size_t& lit) {
  PhongRun run(shader);
  std::vector<Rgb> colours(facets.size(), Rgb::Constant(-1));
  for (std::size_t i = 0; i < facets.size(); ++i) {
    run.add(facets[i], weights[i], colours[i]);
    if (i % 37 == 0) run.finish();  // shorter runs, too
  }
  run.finish();
  std::size_t wrong = 0;
  std::vector<LightCosines> cosines;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const Rgb one = shader.phong(facets[i], weights[i], cosines);
    wrong += !(colours[i] == one).all();
    lit += one.maxCoeff() > 0.5;
  }
  return wrong;
}

// CLAIM      IU.3.3: several pixels at once have the bits of each alone, under lights of every kind, with patterns; also where interpolated
//            normals cancel, where the point is a light, and where it is the eye.
// ORACLE     identity: FacetShader::phong(), which ShadedView.ShowsWhatTheFormulasSay holds against the formulas.
// TOLERANCE  none.
TEST(PhongRun, HasTheBitsOfEachPixelAlone) {
  proves({"IU.3.3"}, Oracle::identity, "10,003 points of random facets, four kinds of light");
  const Scene scene = lit_scene();
  const FacetShader shader(scene, Shading::phong);
  CounterRandom random(4242);
  std::vector<Facet> facets = degenerate(scene, random);
  std::vector<Eigen::Array3d> weights(facets.size(), Eigen::Array3d(1, 0, 0));
  for (int i = 0; i < 10000; ++i) {
    facets.push_back(random_facet(random));
    const double a = random.unit(), b = random.between(0, 1 - a);
    weights.push_back({a, b, 1 - a - b});
  }
  std::size_t lit = 0;
  EXPECT_TRUE(all_agree(differing(shader, facets, weights, lit), facets.size()));
  EXPECT_GT(lit, 3000u);
}

// CLAIM      What asks for more than two products is shaded alone.
// ORACLE     identity: the kinds of material, one by one.
// TOLERANCE  none.
TEST(PhongRun, TakesWhatPhongsLawShades) {
  proves({}, Oracle::identity, "four kinds of material");
  Material plain = diffuse(0.5), bumpy = plain, faceted = plain, mirror = plain;
  bumpy.bump.emplace();
  faceted.highlight.emplace();
  CubeImages black{1, {}};
  for (auto& pixels : black.pixels) pixels.assign(1, Rgb::Zero());
  mirror.environment = std::make_shared<const CubeMap>(black);
  EXPECT_TRUE(holds(PhongRun::takes(plain)));
  EXPECT_FALSE(PhongRun::takes(bumpy));
  EXPECT_FALSE(PhongRun::takes(faceted));
  EXPECT_FALSE(PhongRun::takes(mirror));
}

}  // namespace
}  // namespace etendue::validation
