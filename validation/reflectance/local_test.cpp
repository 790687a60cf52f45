// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/local.hpp"

#include <cmath>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/reflectance/ambient.hpp"
#include "etendue/reflectance/attenuation.hpp"
#include "etendue/reflectance/cosines.hpp"
#include "etendue/reflectance/phong.hpp"
#include "optics/incidence.hpp"
#include "reflectance/colour.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

// Dyadic angles: L and V in a plane with N, cosines 3/5 and 4/5 up to one rounding.
const Vec3 kNormal(0, 0, 1), kLight(-0.6, 0, 0.8), kMirrored(0.6, 0, 0.8);

// CLAIM      IU.2-1, IU.2-4: without lights a surface returns k_a I_a, per channel and at any place and angle.
// ORACLE     exact: dyadic numbers.
// TOLERANCE  none.
TEST(Ambient, ReturnsItsShareOfTheGeneralLight) {
  proves({"IU.2-1", "IU.2-4"}, Oracle::exact, "dyadic products");
  const Rgb k(0.5, 0.25, 1), light(0.5, 1, 0.125), expected(0.25, 0.25, 0.125);
  EXPECT_TRUE(within(difference(ambient(k, light), expected), 0));
  LocalReflection surface;
  surface.k_a = k;
  Directions random(2501);
  for (int i = 0; i < 100; ++i)
    EXPECT_TRUE(within(difference(local_reflection(surface, random.unit(), random.unit(), light, {}), expected), 0));
}

// CLAIM      IU.2-2, IU.2-3, IU.2-4, IU.2-5, IU.2-6, IU.2-7, IU.2.8, IU.2.9: the whole model per channel, with
//            several lights, equals the formula written from angles; a light behind adds nothing.
// ORACLE     closed form from the angles θ_i and φ_i with which the vectors were made.
// TOLERANCE  per light: lambert 8 u and phong_error(n) with 8 u n for placing the vectors, times intensities below 4.
TEST(LocalReflection, IsTheFormulaOfTheAnglesSummedOverTheLights) {
  proves({"IU.2-2", "IU.2-3", "IU.2-4", "IU.2-5", "IU.2-6", "IU.2-7", "IU.2.8", "IU.2.9"}, Oracle::closed_form,
         "the formula in angles");
  Directions random(2502);
  for (int i = 0; i < 1000; ++i) {
    LocalReflection surface;
    surface.k_a = Rgb(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    surface.k_d = Rgb(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    surface.k_s = random.uniform(0, 1);
    surface.exponent = random.integer(1, 200);
    const Vec3 n = random.unit(), across = random.orthogonal_to(n);
    const double viewer_angle = random.uniform(-1.5, 1.5);  // all in one plane: φ is a difference of angles
    const Vec3 v = (std::cos(viewer_angle) * n + std::sin(viewer_angle) * across).normalized();
    const Rgb ambient_light(0.2, 0.3, 0.4);
    Rgb expected = surface.k_a * ambient_light;
    std::vector<IncidentLight> lights;
    double tolerance = 8 * u;
    for (int light = 0; light < 3; ++light) {
      const double theta = random.uniform(-2.5, 2.5), distance = random.uniform(1, 4), d0 = random.uniform(0, 1);
      const Vec3 l = (std::cos(theta) * n + std::sin(theta) * across).normalized();
      const Rgb intensity(random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4));
      lights.push_back({l, intensity, linear_attenuation(distance, d0)});
      tolerance += 4 * (8 * u + phong_error(surface.exponent) + 8 * u * surface.exponent + 8 * u);
      if (std::cos(theta) <= 0) continue;
      const double lobe = std::pow(std::max(0.0, std::cos(viewer_angle + theta)), surface.exponent);
      expected += intensity / (distance + d0) * (surface.k_d * std::cos(theta) + surface.k_s * lobe);
    }
    EXPECT_TRUE(within(difference(local_reflection(surface, n, v, ambient_light, lights), expected), tolerance));
  }
}

// CLAIM      IU.3.4, IU.2.2: from scalar products a surface reflects what it does from the vectors, without a highlight of its own too, and
//            matt ones; a light behind adds nothing.
// ORACLE     metamorphic: local_reflection() of the vectors.
// TOLERANCE  phong_error(n) for each, with 14 u n for the products, and 8 u for sums of numbers below four, times three lights.
TEST(LocalReflection, IsTheSameFromScalarProducts) {
  proves({"IU.3.4", "IU.2.2"}, Oracle::metamorphic, "local_reflection() of 500 times three lights");
  uses_seed(2503);
  Directions random(2503);
  for (int i = 0; i < 500; ++i) {
    LocalReflection surface;
    surface.k_a = surface.k_d = Rgb(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    surface.k_s = i % 4 == 0 ? 0 : random.uniform(0, 1);
    surface.exponent = random.integer(1, 100);
    const Vec3 n = random.unit(), v = random.unit();
    std::vector<IncidentLight> lights;
    std::vector<LightCosines> cosines;
    std::vector<Rgb> intensities;
    for (int light = 0; light < 3; ++light) {
      lights.push_back({random.unit(), Rgb(random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4)), 1});
      cosines.push_back(light_cosines(n, lights.back().to_light, v));
      intensities.push_back(lights.back().intensity);
    }
    const Rgb expected = local_reflection(surface, n, v, Rgb(0.2, 0.3, 0.4), lights);
    const double tolerance = 3 * 4 * (2 * phong_error(surface.exponent) + 14 * u * surface.exponent + 8 * u);
    EXPECT_TRUE(within(difference(reflection_of_cosines(surface, Rgb(0.2, 0.3, 0.4), cosines, intensities), expected),
                       tolerance));
  }
}

// CLAIM      IU.2.2, IU.2.9: a surface's colour tints the diffuse part only; its highlight has the colour of the light.
// ORACLE     identity: difference of the same surface with and without k_s.
// TOLERANCE  phong_error(n) at the peak, 8 u for sums of numbers below two.
TEST(LocalReflection, LeavesTheHighlightUncoloured) {
  proves({"IU.2.2", "IU.2.9"}, Oracle::identity, "with and without the directed part");
  LocalReflection surface;
  surface.k_d = Rgb(0.9, 0.1, 0);
  surface.exponent = 20;
  const std::vector<IncidentLight> lights = {{kLight, Rgb(1, 0.5, 0.25), 1}};
  const Rgb matt = local_reflection(surface, kNormal, kMirrored, Rgb::Zero(), lights);
  surface.k_s = 0.8;
  const Rgb glossy = local_reflection(surface, kNormal, kMirrored, Rgb::Zero(), lights);
  EXPECT_TRUE(within(difference(matt, Rgb(0.9, 0.05, 0) * 0.8), 8 * u));
  EXPECT_TRUE(within(difference(glossy - matt, Rgb(0.8, 0.4, 0.2)), phong_error(20) + 8 * u));
}

// CLAIM      E2: with k_d in front of the whole sum, as 5-2 prints it, a black glossy surface (k_d = 0, k_s = 0.9)
//            has no highlight; as in 2-7 it has 0.9.
// ORACLE     closed form at V = R.
// TOLERANCE  phong_error(n).
TEST(LocalReflection, GivesABlackGlossySurfaceItsHighlight) {
  proves({"E2", "IU.2-7"}, Oracle::closed_form, "k_s at V = R");
  LocalReflection surface;
  surface.k_s = 0.9;
  surface.exponent = 50;
  const double k_d = 0, printed = k_d * (kNormal.dot(kLight) + 0.9 * std::pow(kMirrored.dot(kMirrored), 50));
  EXPECT_TRUE(near(printed, 0, 0));
  const std::vector<IncidentLight> lights = {{kLight, Rgb(1, 1, 1), 1}};
  const Rgb mended = local_reflection(surface, kNormal, kMirrored, Rgb::Zero(), lights);
  EXPECT_TRUE(within(difference(mended, Rgb(0.9, 0.9, 0.9)), phong_error(50)));
}

// CLAIM      E3: R must be the mirror direction of each light. Taken as that of V, a light at 89° makes a highlight
//            of 1 where there is one of 1.2e-88 (viewer on the normal, n = 50).
// ORACLE     closed form: cos⁵⁰ 89°.
// TOLERANCE  relative: n times the angle's rounding over cos 89°, 50 · 8 u / 0.017.
TEST(LocalReflection, MirrorsEachLightOfItsOwn) {
  proves({"E3", "IU.2-7"}, Oracle::closed_form, "cos⁵⁰ 89°");
  const double theta = 89 * kDegree;
  const Vec3 l(std::sin(theta), 0, std::cos(theta)), v = kNormal;
  const double printed = std::pow(reflect(-v, kNormal).dot(v), 50);
  EXPECT_TRUE(near(printed, 1, phong_error(50)));
  const double mended = phong(kNormal, l, v, 50), expected = std::pow(std::cos(theta), 50);
  EXPECT_TRUE(near(mended / expected, 1, 50 * (reflection_error() + 8 * u) / std::cos(theta)));
  EXPECT_TRUE(near(mended / 1.2e-88, 1, 0.05));
}

}  // namespace
}  // namespace etendue::validation
