// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/optics/colour.hpp"
#include "etendue/raytracing/render.hpp"
#include "optics/incidence.hpp"
#include "oracles/optics.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

// What surfaces send on: Fresnel's shares of the light, and for each wavelength its own way.
namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

Material dispersive(const char* medium) {
  Material material = specular(0, 1);
  material.dispersion = find_medium(medium)->dispersion;
  material.eta = refractive_index(*material.dispersion, kLineD);
  return material;
}

/// Prism of 60° with its edge along y above the origin and a side of 2, lying on z = 0.
Mesh prism() {
  const double h = std::sqrt(3.0);
  Mesh mesh;
  mesh.vertices = {{-1, -9, 0}, {1, -9, 0}, {0, -9, h}, {-1, 9, 0}, {1, 9, 0}, {0, 9, h}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}};
  return mesh;
}

/// A ray in the plane y = 0 onto the middle of the prism's left face, at an angle to its normal.
Ray onto_prism(double theta) {
  const double tilt = 30 * kDegree - theta;  // of the ray to the x-axis, so that it rises with the angle of incidence
  const Vec3 direction(std::cos(-tilt), 0, std::sin(-tilt));
  return {Vec3(-0.5, 0, std::sqrt(3.0) / 2) - 5 * direction, direction};
}

/// How far a prism of angle A turns a ray: θ + asin(sin A sqrt(n² − sin² θ) − cos A sin θ) − A.
double deviation(double n, double theta) {
  const double a = 60 * kDegree, s = std::sin(theta);
  return theta + std::asin(std::sin(a) * std::sqrt(n * n - s * s) - std::cos(a) * s) - a;
}

// CLAIM      IU.4-6: a prism turns each colour by another angle, when the wavelengths are kept, and all by one angle with a
//            mean index: n_d, the same without a wavelength as with that of the line d.
// ORACLE     closed form: the deviation of a prism of 60° with the index of the catalogue, for three lines, five glasses.
// TOLERANCE  the indices are the catalogue's to 5e-6; the deviation changes by at most 5 of that at 50° to 70°. Between no
//            wavelength and the line d: none.
TEST(Spectrum, IsSpreadByAPrism) {
  proves({"IU.4-6"}, Oracle::closed_form, "deviation of a prism for the lines d, F, C");
  struct Glass {
    const char* name;
    double d, f, c;
  };
  for (const Glass& glass : {Glass{"N-BK7", 1.51680, 1.52238, 1.51432}, Glass{"F2", 1.62004, 1.63208, 1.61503},
                             Glass{"N-SF11", 1.78472, 1.80651, 1.77596}}) {
    Scene scene;
    add(scene, prism(), dispersive(glass.name));
    const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
    for (const double theta_deg : {55.0, 63.0, 70.0}) {
      const Ray ray = onto_prism(theta_deg * kDegree);
      const auto leaving = [&](double wavelength) {
        const RayTree tree = trace(ray, *accelerator, {}, {{}, wavelength});
        EXPECT_EQ(tree.nodes.size(), 3u);
        return tree.nodes.back().ray.direction;
      };
      const auto turned = [&](double wavelength) {
        return std::atan2(ray.direction.cross(leaving(wavelength)).norm(), ray.direction.dot(leaving(wavelength)));
      };
      const double theta = theta_deg * kDegree;
      EXPECT_TRUE(near(turned(kLineD), deviation(glass.d, theta), 5 * 5e-6));
      EXPECT_TRUE(near(turned(kLineF), deviation(glass.f, theta), 5 * 5e-6));
      EXPECT_TRUE(near(turned(kLineC), deviation(glass.c, theta), 5 * 5e-6));
      EXPECT_TRUE(apart(turned(kLineF), turned(kLineC), 0.005)) << "there is a rainbow";
      EXPECT_TRUE(holds(leaving(0) == leaving(kLineD))) << "and none with a mean index";
    }
  }
}

// CLAIM      In parts of the visible light: a stripe that only red light reaches through the prism is red, one that only blue
//            reaches is blue; a white sky through the prism stays white; a scene that disperses nothing keeps every bit.
// ORACLE     closed form: where the deviation for 650 nm and 450 nm leads; weights that sum to one; the same ray without.
// TOLERANCE  white: 4 N u of the weights, 16 u for each sum; else none.
TEST(Spectrum, IsSummedToTheMonitorsColours) {
  proves({"IU.4-6", "IU.2.9b"}, Oracle::closed_form, "stripes at the feet of 650 nm and 450 nm; white light in parts");
  const double theta = 63 * kDegree;
  const Ray ray = onto_prism(theta);
  RenderOptions options;
  options.wavelengths = 60;
  const Material glass = dispersive("N-SF11");
  const auto stripe = [&](double wavelength) {
    Scene scene;
    add(scene, prism(), glass);
    Scene alone = scene;
    const auto path = trace(ray, *make_accelerator(alone, AcceleratorKind::brute_force), {}, {{}, wavelength});
    const Ray out = path.nodes.back().ray;
    Material shining;
    shining.emission = Rgb::Ones();
    add(scene, Disc{out.at(50), out.direction, 0.25}, shining);
    return see(ray, *make_accelerator(scene, AcceleratorKind::bounding_volumes), options, {}).colour;
  };
  const Rgb red = stripe(650), blue = stripe(450);
  EXPECT_TRUE(holds(red[0] > 0 && red[0] > 5 * std::abs(red[1]) && red[0] > 5 * std::abs(red[2])));
  EXPECT_TRUE(holds(blue[2] > 0 && blue[2] > 5 * std::abs(blue[1]) && blue[2] > 5 * std::abs(blue[0])));

  Scene white;
  add(white, prism(), glass);
  white.background = {1, 0.5, 0.25};
  const Seen parts = see(ray, *make_accelerator(white, AcceleratorKind::bounding_volumes), options, {});
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(near(parts.colour[k], white.background[k], 400 * u));
  EXPECT_EQ(parts.counts.eye_rays, 60u);
  white.materials[0].dispersion.reset();
  const auto mean = make_accelerator(white, AcceleratorKind::bounding_volumes);
  const Seen whole = see(ray, *mean, options, {});
  EXPECT_EQ(whole.counts.eye_rays, 1u);
  EXPECT_TRUE(holds((whole.colour == see(ray, *mean, {}, {}).colour).all()));
}

// CLAIM      Fresnel's shares: F of k_r + k_t is reflected and the rest transmitted, at every hit, also from inside, and all of
//            it under total reflection: a body that takes nothing is invisible in a uniform sky, but for the rays not followed.
// ORACLE     identity: children carry k_r + k_t; the background weighed by what was followed. F at normal incidence.
// TOLERANCE  four roundings a hit; 64 levels' sums.
TEST(FresnelShares, KeepTheEnergy) {
  proves({"IU.5-2", "IU.5.3tir"}, Oracle::identity, "reflected and transmitted share sum to k_r + k_t");
  Directions random(5301);
  Material glass = specular(0.25, 0.75, 1.5);
  glass.fresnel = true;
  std::uint64_t total = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Scene scene;
    scene.background = Rgb::Ones();
    add(scene, Box{{0, 0, 0}, Mat3::Identity(), {1, 2, 3}}, glass);
    add(scene, Sphere{{3, 1, 0}, 1.5}, glass);
    const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
    const Vec3 from = 9 * random.unit();
    const RayTree tree = trace({from, (random.unit() - from).normalized()}, *accelerator, {14, 1e-3});
    std::vector<double> sent(tree.nodes.size(), 0);
    double cut = 0;
    for (std::size_t i = 1; i < tree.nodes.size(); ++i) sent[tree.nodes[i].parent] += tree.nodes[i].coefficient;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      const RayNode& node = tree.nodes[i];
      if (node.end == RayEnd::surface) {
        EXPECT_TRUE(near(sent[i], 1, 4 * u));
        total += i + 1 < tree.nodes.size() && tree.nodes[i + 1].coefficient == 1;
      } else if (node.end != RayEnd::left_scene) {
        cut += node.weight;
      }
    }
    EXPECT_TRUE(near(shade(tree, *accelerator).colour[1] + cut, 1, 64 * 4 * u));
  }
  EXPECT_GT(total, 50u) << "total reflection occurs";
  Scene pane;
  add(pane, Plane{{0, 0, 0}, {0, 0, 1}}, glass);
  const auto accelerator = make_accelerator(pane, AcceleratorKind::brute_force);
  const RayTree tree = trace({{0, 0, 1}, {0, 0, -1}}, *accelerator, {});
  EXPECT_TRUE(near(tree.nodes[1].coefficient, 0.04, 0.04 * 32 * u));
  EXPECT_TRUE(near(tree.nodes[2].coefficient, 0.96, 4 * u));
}

}  // namespace
}  // namespace etendue::validation
