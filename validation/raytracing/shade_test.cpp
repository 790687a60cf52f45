// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/shade.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "etendue/core/rounding.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Rgb colour_along(const Ray& ray, const Scene& scene) {
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  return shade(trace(ray, *accelerator, {}), *accelerator).colour;
}

DirectionalLight light_from(double angle_deg) {
  return {{std::sin(angle_deg * kDegree), 0, std::cos(angle_deg * kDegree)}, Rgb::Ones()};
}

// A black floor with a highlight of exponent 50, and one light.
Scene glossy_floor(double k_s, double light_angle_deg) {
  Material glossy;
  glossy.k_s = k_s;
  glossy.phong_exponent = 50;
  Scene scene;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, glossy);
  scene.lights = {light_from(light_angle_deg)};
  return scene;
}

// CLAIM      E2: k_d tints the diffuse term only. A black, glossy surface that mirrors the light to the eye shows 0.9;
//            as printed, with k_d before the whole sum, it would show nothing.
// ORACLE     closed form: L = V = N, so N·L = R·V = 1.
// TOLERANCE  50 times the error of R·V (30 u), for the power of 50.
TEST(Shade, LeavesTheHighlightUntinted) {
  proves({"E2", "IU.5-2"}, Oracle::closed_form, "both forms at normal incidence");
  const Scene scene = glossy_floor(0.9, 0);
  const double k_d = 0, printed = k_d * (1 + 0.9);
  EXPECT_EQ(printed, 0);
  EXPECT_TRUE(near(colour_along({{0, 0, 5}, {0, 0, -1}}, scene)[0], 0.9, 50 * 30 * kUnitRoundoff));
}

// CLAIM      E3: R is the mirror of each light's own direction. With the light at 89° and the eye on the normal, R_i·V
//            is cos 89°, and the highlight is 1e-88; the mirror of V, the only R without index, would give 1.
// ORACLE     closed form: cos(89°)^50.
// TOLERANCE  relative: 50 times the error of R·V, 30 u, over cos 89°.
TEST(Shade, MirrorsEachLight) {
  proves({"E3", "IU.5-2"}, Oracle::closed_form, "cos(89°)^50 against 1");
  const Scene scene = glossy_floor(1, 89);
  const double cosine = std::cos(89 * kDegree), expected = std::pow(cosine, 50);
  EXPECT_LT(expected, 1.3e-88);
  const double printed = std::pow(Vec3(0, 0, 1).dot(Vec3(0, 0, 1)), 50);  // R of V = N is N
  EXPECT_EQ(printed, 1);
  EXPECT_TRUE(
      near(colour_along({{0, 0, 5}, {0, 0, -1}}, scene)[0], expected, expected * 50 * 30 * kUnitRoundoff / cosine));
}

// CLAIM      IU.5-2 with several lights: ambient, and the sum over the lights, per channel.
// ORACLE     closed form: k_a I_a + k_d Σ I_p cos, for lights at 0°, 60° and behind the surface.
// TOLERANCE  eight roundings.
TEST(Shade, SumsAmbientAndLights) {
  proves({"IU.5-2"}, Oracle::closed_form, "hand-made sum of three lights");
  Material material = diffuse(0.5);
  material.k_d = {0.5, 0.25, 0};
  material.k_a = {0.1, 0.2, 0.4};
  material.emission = {0, 0, 0.125};
  Scene scene;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, material);
  scene.ambient = {0.5, 0.5, 0.5};
  DirectionalLight red = light_from(60);
  red.intensity = {1, 0, 0};
  scene.lights = {light_from(0), red, light_from(120)};
  const Rgb colour = colour_along({{0, 0, 5}, {0, 0, -1}}, scene);
  EXPECT_TRUE(near(colour[0], 0.05 + 0.5 + 0.25, 8 * kUnitRoundoff));
  EXPECT_TRUE(near(colour[1], 0.1 + 0.25, 8 * kUnitRoundoff));
  EXPECT_TRUE(near(colour[2], 0.2 + 0.125, 8 * kUnitRoundoff));
}

// CLAIM      N is the normal on the viewer's side: a thin surface looks the same from both sides, with the light on the viewer's,
//            and is dark with the light on the other.
// ORACLE     closed form: cos 60°, whichever way the normal of the shape points.
// TOLERANCE  four roundings.
TEST(Shade, TurnsTheNormalToTheViewer) {
  proves({"IU.5-2"}, Oracle::closed_form, "one disc with both normals, seen from both sides");
  for (const double normal : {1.0, -1.0}) {
    for (const double side : {1.0, -1.0}) {
      Scene scene;
      add(scene, Disc{{0, 0, 0}, {0, 0, normal}, 1}, diffuse(0.5));
      DirectionalLight light = light_from(60);
      light.direction.z() *= side;
      scene.lights = {light};
      const Ray view{{0, 0, 3 * side}, {0, 0, -side}}, behind{{0, 0, -3 * side}, {0, 0, side}};
      EXPECT_TRUE(near(colour_along(view, scene)[0], 0.25, 4 * kUnitRoundoff));
      EXPECT_EQ(colour_along(behind, scene)[0], 0);
    }
  }
}

// CLAIM      IU.5.4a: only a hit nearer than the light blocks; each light has its own shadow ray; a blocked light adds
//            nothing, the others and the ambient light stay.
// ORACLE     closed form: a disc before the light, behind the light, and before one light of two.
// TOLERANCE  eight roundings.
TEST(Shade, IsInShadowOnlyOfWhatStandsBeforeTheLight) {
  proves({"IU.5.4a"}, Oracle::closed_form, "blocker before the light, behind it, and before one of two");
  const auto seen = [](double blocker_height, bool second_light) {
    Scene scene;
    add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, diffuse(0.5));
    add(scene, Disc{{0, 0, blocker_height}, {0, 0, 1}, 0.25}, diffuse(0.5));
    scene.ambient = Rgb::Constant(0.25);
    scene.lights = {PointLight{{0, 0, 4}, Rgb::Ones()}};
    if (second_light) scene.lights.push_back(PointLight{{3, 0, 4}, Rgb::Ones()});
    return colour_along({{3, 4, 12}, Vec3(-3, -4, -12) / 13}, scene)[0];
  };
  EXPECT_TRUE(near(seen(3.5, false), 0.125, 8 * kUnitRoundoff));
  EXPECT_TRUE(near(seen(4.5, false), 0.625, 8 * kUnitRoundoff));
  EXPECT_TRUE(near(seen(3.5, true), 0.125 + 0.5 * 0.8, 8 * kUnitRoundoff));
  EXPECT_TRUE(near(seen(4.5, true), 0.625 + 0.5 * 0.8, 8 * kUnitRoundoff));
}

// CLAIM      RT.14, R7: for a directional light that travels along l the shadow ray is RT(M, −l, …): what it finds are
//            blockers of M. Along l, or with "−1", it would look the other way.
// ORACLE     closed form: one blocker on the light's side, then one on the far side.
// TOLERANCE  none: lit or not.
TEST(Shade, LooksForBlockersAgainstTheLight) {
  proves({"RT.14", "R7", "R8"}, Oracle::closed_form, "a blocker towards the light, and one away from it");
  const Vec3 travel = Vec3(1, 0, -1).normalized();
  Scene scene;
  scene.lights = {DirectionalLight{-travel, Rgb::Ones()}};
  add(scene, Disc{{0, 0, 0}, {0, 0, 1}, 1}, diffuse(0.5));
  const Ray view{{0, 0, 9}, {0, 0, -1}};
  EXPECT_GT(colour_along(view, scene)[0], 0);
  add(scene, Sphere{4 * travel, 0.5}, diffuse(0.5));  // behind the disc, along l
  EXPECT_GT(colour_along(view, scene)[0], 0);
  scene.objects[1].shape = Sphere{-4 * travel, 0.5};  // between the disc and the light
  EXPECT_EQ(colour_along(view, scene)[0], 0);

  const auto accelerator = make_accelerator(scene, AcceleratorKind::brute_force);
  const auto hit = accelerator->nearest(view).hit;
  ASSERT_TRUE(hit.has_value());
  const Ray shadow = shadow_ray(hit->hit, scene.lights[0]);
  EXPECT_TRUE(within((shadow.direction + travel).norm(), 4 * kUnitRoundoff));
  EXPECT_EQ(shadow.t_min, 0);  // the open half-line t > 0; no ε
  EXPECT_TRUE(std::isinf(shadow.t_max));
}

// CLAIM      R7: t is a length only for a direction of length one: along one of length 2 a blocker at distance 1 is found
//            at t = 0.5. ε is the third parameter of RT, the least t: it leaves out what is nearer than it.
// ORACLE     exact: dyadic coordinates; a disc across the ray, for either kind of accelerator.
// TOLERANCE  none: dyadic numbers, found or not.
TEST(Shade, MeasuresTInLengthsOfTheDirection) {
  proves({"R7", "RT.14"}, Oracle::exact, "a blocker at distance 1 along directions of length 1, 2 and 4");
  Scene scene;
  add(scene, Disc{{0, 0, 1}, {0, 0, 1}, 1}, diffuse(0.5));
  for (const AcceleratorKind kind : {AcceleratorKind::brute_force, AcceleratorKind::bounding_volumes}) {
    const auto accelerator = make_accelerator(scene, kind);
    for (const double length : {1.0, 2.0, 4.0}) {
      const double expected = 1 / length;
      const auto blocker = [&](double least) { return accelerator->nearest({{0, 0, 0}, {0, 0, length}, least}).hit; };
      const auto found = blocker(0);
      ASSERT_TRUE(found.has_value());
      EXPECT_TRUE(near(found->hit.t, expected, 0));
      EXPECT_TRUE(holds(blocker(0.75 * expected).has_value())) << "ε below the blocker";
      EXPECT_TRUE(holds(!blocker(1.25 * expected).has_value())) << "ε beyond the blocker";
      const auto blocked = [&](double least) {
        return accelerator->obstruction({{0, 0, 0}, {0, 0, length}, least}).blocked;
      };
      EXPECT_TRUE(holds(blocked(0.75 * expected) && !blocked(1.25 * expected)));
    }
    const auto twice = accelerator->nearest({{0, 0, 0}, {0, 0, 2}}).hit;
    ASSERT_TRUE(twice.has_value());
    EXPECT_TRUE(apart(twice->hit.t, 1, 0.25)) << "t taken for the distance";
  }
}

// CLAIM      IU.5.4b, G8: no acne. A convex shape never shades its own lit side, whatever its size and place; the
//            text's ε = 1e-5 would be lost in the rounding of coordinates, or leap over a small shape.
// ORACLE     identity: a lone sphere is lit exactly where N·L > 0.
// TOLERANCE  none; points within 1e-6 of the terminator are left out, where the sign of N·L itself is rounding.
TEST(Shade, HasNoAcneAtAnyScale) {
  proves({"IU.5.4b", "G8"}, Oracle::identity,
         "a lone sphere shades itself nowhere, from 1e-6 to 1e9, far from the origin");
  constexpr double kTerminator = 1e-6;
  std::mt19937_64 random(54);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vec3(x, y, z).normalized();
  };
  std::uint64_t wrong = 0, decisions = 0;
  for (const double radius : {1e-6, 1e-3, 1.0, 1e3, 1e9}) {
    for (const double offset : {0.0, 1.0, 1e3, 1e6}) {
      Scene scene;
      const Sphere sphere{offset * radius * direction(), radius};
      add(scene, sphere, diffuse(1));
      const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
      for (int trial = 0; trial < 500; ++trial) {
        const Vec3 out = direction(), towards_light = direction();
        const Light light = DirectionalLight{towards_light, Rgb::Ones()};
        const Vec3 eye = sphere.centre + 3 * radius * out;
        const Vec3 aim = sphere.centre + 0.9 * radius * direction();
        const auto met = accelerator->nearest({eye, (aim - eye).normalized()}).hit;
        if (!met || std::abs(met->hit.normal.dot(towards_light)) < kTerminator) continue;
        ++decisions;
        const bool blocked = accelerator->obstruction(shadow_ray(met->hit, light)).blocked;
        if (blocked != (met->hit.normal.dot(towards_light) < 0)) ++wrong;
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, decisions));
  EXPECT_GT(decisions, 9000u);
}

// CLAIM      IU.4-1: where a pattern shows its first colours they are the material's k_d and k_a; where it shows the second, the pattern's.
// ORACLE     exact: two squares of a checkerboard; between, half way across a ring of wood, where the share is a quarter: (½)².
// TOLERANCE  none for squares; of wood the roundings of a square and a blend, 8 u.
TEST(Shading, TakesThePatternsColours) {
  proves({"IU.4-1"}, Oracle::exact, "squares by hand; a quarter of the second colour");
  Material tiles = diffuse(0.5);
  tiles.k_a = Rgb::Constant(0.25);
  tiles.pattern = MaterialPattern{Checkerboard{}, Rgb::Constant(0.125), Rgb::Constant(0.0625)};
  const SurfaceColour first = colour_at(tiles, {0.5, 0.5, 0}), second = colour_at(tiles, {1.5, 0.5, 0});
  EXPECT_TRUE(holds(first.k_d[0] == 0.5 && first.k_a[0] == 0.25));
  EXPECT_TRUE(holds(second.k_d[0] == 0.125 && second.k_a[0] == 0.0625));
  Material wood = tiles;
  wood.pattern->pattern = Wood{};
  const SurfaceColour blend = colour_at(wood, {0.5, 0, 0});  // no crook: h = 0 and φ = 0
  EXPECT_TRUE(near(blend.k_d[0], 0.75 * 0.5 + 0.25 * 0.125, 8 * kUnitRoundoff));
  EXPECT_TRUE(near(blend.k_a[0], 0.75 * 0.25 + 0.25 * 0.0625, 8 * kUnitRoundoff));
}

}  // namespace
}  // namespace etendue::validation
