// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <optional>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/view/shaded_view.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"

// Figures 8, 9 and 13: the scenes have the parameters that the text prints, and their pictures, by rays and by rasteriser, are
// what equations 2-3, 2-4 and 2-7 give at the points of the spheres.
namespace etendue::validation {
namespace {

using Long = long double;
using Long3 = Eigen::Matrix<Long, 3, 1>;

Scene scene_named(const std::string& folder) {
  auto read = read_scene(source_root() / "scenes" / folder / "scene.json");
  EXPECT_TRUE(read.ok());
  return read->scene;
}

/// What a sphere of a figure is made of, in the text's terms; I_p = 1.
struct Row {
  Long k_d, ambient, k_s, n;
};

struct Met {
  std::size_t sphere;
  Long3 normal, to_viewer;
  Long depth;  // γ of 5-11, by R²: how far inside the outline
};

/// The nearest sphere along the ray through a place of the picture [pixels], by IU.5.2 and 5-9 … 5-11 written out.
std::optional<Met> met(const Scene& scene, double column, double row) {
  const Camera& camera = scene.camera;
  const Long3 eye = camera.eye.cast<Long>();
  const Long3 g = camera.gaze.cast<Long>().normalized(), x = g.cross(Long3(camera.up.cast<Long>())).normalized(),
              y = x.cross(g);
  const Long tan_h = std::tan(static_cast<Long>(camera.horizontal_half_angle)),
             tan_v = tan_h * camera.rows / camera.columns;
  const Long3 d =
      (g + (2 * column / camera.columns - 1) * tan_h * x + (1 - 2 * row / camera.rows) * tan_v * y).normalized();
  std::optional<Met> nearest;
  Long at = 1e9L;
  for (std::size_t s = 0; s < scene.objects.size(); ++s) {
    const auto& sphere = std::get<Sphere>(scene.objects[s].shape);
    const Long3 way = sphere.centre.cast<Long>() - eye;
    const Long mu = d.dot(way), r = sphere.radius, gamma = mu * mu - way.squaredNorm() + r * r;
    if (gamma <= 0 || mu - std::sqrt(gamma) >= at) continue;
    at = mu - std::sqrt(gamma);
    nearest = Met{s, (at * d - way) / r, -d, gamma / (r * r)};
  }
  return nearest;
}

Long intensity(const Row& row, const Met& met, const Long3& to_light) {
  const Long cosine = met.normal.dot(to_light);
  Long sum = row.k_d * row.ambient;
  if (cosine <= 0) return sum;
  const Long mirror = (2 * cosine * met.normal - to_light).dot(met.to_viewer);
  return sum + row.k_d * cosine + row.k_s * std::pow(std::max<Long>(mirror, 0), row.n);
}

/// Holds a scene and its two pictures against the table of its figure.
void check(const std::string& folder, const std::vector<Row>& table) {
  Scene scene = scene_named(folder);
  ASSERT_EQ(scene.objects.size(), table.size());
  ASSERT_EQ(scene.lights.size(), 1u);
  const auto& light = std::get<DirectionalLight>(scene.lights[0]);
  EXPECT_TRUE(holds((light.intensity == 1).all()));
  for (std::size_t s = 0; s < table.size(); ++s) {
    const Material& m = scene.materials[scene.objects[s].material];
    EXPECT_TRUE(
        holds((m.k_d == static_cast<double>(table[s].k_d)).all() && m.k_s == static_cast<double>(table[s].k_s)));
    EXPECT_TRUE(holds(m.k_s == 0 || m.phong_exponent == static_cast<double>(table[s].n)));
    const Rgb ambient = m.k_a * scene.ambient;
    EXPECT_TRUE(within((ambient - static_cast<double>(table[s].k_d * table[s].ambient)).abs().maxCoeff(), 0x1p-52));
  }
  const Long3 to_light = light.direction.cast<Long>();
  RenderOptions once;
  once.sampling.samples_per_side = 1;
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const Image traced = render(*accelerator, once, {}).value().image;
  ShadingOptions options;
  options.net.facets = 256;
  options.samples = 1;
  const Image drawn = view_shaded(scene, options).value().image;
  std::uint64_t wrong = 0, decided = 0, inside = 0;
  for (int row = 0; row < traced.rows; ++row) {
    for (int column = 0; column < traced.columns; ++column) {
      const auto here = met(scene, column + 0.5, row + 0.5);
      const double expected = here ? static_cast<double>(intensity(table[here->sphere], *here, to_light)) : 0;
      ++decided;
      const double shown = traced.at(column, row)[0];
      if (!here) {
        wrong += shown != 0;
        continue;
      }
      // The ray's direction errs by 2^-45 at most; 40 away that moves the point, and the normal, by 40/√γ of it; n magnifies.
      const double moved = 0x1p-45 * 40 / static_cast<double>(std::sqrt(here->depth));
      const double steepness = 1 + static_cast<double>(table[here->sphere].k_s * table[here->sphere].n);
      EXPECT_TRUE(near(shown, expected, 4 * moved * steepness)) << column << " " << row;
      // Of a net the point lies deeper by 1 − cos(π/256), and is seen at a turned place beside the outline; normals err by as much.
      if (here->depth < 0.2L) continue;
      ++inside;
      EXPECT_TRUE(near(drawn.at(column, row)[0], expected, 8e-4 * steepness)) << column << " " << row;
    }
  }
  EXPECT_GT(inside, decided / 8);
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      IU.f8, IU.f9: four spheres of k_d = 0.1, 0.4, 0.7, 0.95 without ambient light, and four of 0.4 with 0, 20, 40, 60 % of
//            it: the scene has these numbers, and its picture is 2-3 and 2-4 at every pixel.
// ORACLE     known render: the spheres and the equations in long double.
// TOLERANCE  rays: rounding of the direction, moved to the sphere. Rasteriser with 256 facets around, away from the outlines: 8e-4 of
//            the steepness (a facet's arrow, (π/256)²/2 = 7.5e-5, as a share of the radius, times ten for points and normals
//            that it moves).
TEST(KnownRender, OfMattSpheresIsFigures8And9) {
  proves({"IU.f8", "IU.f9", "IU.2-1", "IU.2-2", "IU.2-3", "IU.2-4"}, Oracle::render,
         "spheres and the equations in long double");
  check("matt-spheres", {{0.1L, 0, 0, 1},
                         {0.4L, 0, 0, 1},
                         {0.7L, 0, 0, 1},
                         {0.95L, 0, 0, 1},
                         {0.4L, 0, 0, 1},
                         {0.4L, 0.2L, 0, 1},
                         {0.4L, 0.4L, 0, 1},
                         {0.4L, 0.6L, 0, 1}});
}

// CLAIM      IU.f13: six spheres of k_d = 0.4 and 20 % ambient light: rows k_s = 0.25 and 0.5, columns n = 3, 10, 100: the scene has these
//            numbers, and its picture is 2-7 at every pixel.
// ORACLE     known render: the spheres and the equation in long double.
// TOLERANCE  as above.
TEST(KnownRender, OfGlossySpheresIsFigure13) {
  proves({"IU.f13", "IU.2.7", "IU.2-6", "IU.2-7"}, Oracle::render, "spheres and the equation in long double");
  std::vector<Row> table;
  for (const Long k_s : {0.25L, 0.5L}) {
    for (const Long n : {3.0L, 10.0L, 100.0L}) table.push_back({0.4L, 0.2L, k_s, n});
  }
  check("glossy-spheres", table);
}

// CLAIM      IU.2.1: emitters are directional, with one direction for all points, or points, whose direction changes; each has an
//            intensity for every channel, of which the surface's cosine takes its share.
// ORACLE     closed form: the directions and distances written out, at three points.
// TOLERANCE  4 u of the normalised direction, relative 4 u of the distance.
TEST(Lights, HaveOneDirectionOrManyAndAnIntensity) {
  proves({"IU.2.1"}, Oracle::closed_form, "directions to lights, written out");
  const DirectionalLight sun{Vec3(2, -1, 2) / 3, {1, 0.9, 0.8}};
  const PointLight lamp{{1, 2, 3}, {0.5, 0.4, 0.3}};
  for (const Vec3& point : {Vec3(0, 0, 0), Vec3(5, -2, 1), Vec3(1, 2, -100)}) {
    const LightSample far = towards(Light(sun), point), close = towards(Light(lamp), point);
    EXPECT_TRUE(holds(far.to_light == sun.direction && std::isinf(far.distance)));
    const Long3 way = lamp.position.cast<Long>() - point.cast<Long>();
    EXPECT_TRUE(within((close.to_light - Vec3((way / way.norm()).cast<double>())).cwiseAbs().maxCoeff(), 4 * 0x1p-53));
    EXPECT_TRUE(near(close.distance, static_cast<double>(way.norm()), 4 * 0x1p-53 * close.distance));
  }
}

}  // namespace
}  // namespace etendue::validation
