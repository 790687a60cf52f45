// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/shaded_view.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/image/scan_line.hpp"
#include "etendue/raytracing/render.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

// Shading of nets of polygons, held against an octahedron: its corners are ±e_k and so are their averaged normals, a point of its
// surface has the barycentric coordinates |x|, |y|, |z|.
namespace etendue::validation {
namespace {

constexpr Shading kAllShadings[] = {Shading::flat, Shading::gouraud, Shading::phong, Shading::dot};

Material glossy(double exponent) {
  Material material;
  material.k_d = {0.5, 0.4, 0.3};
  material.k_a = {0.1, 0.2, 0.3};
  material.k_s = 0.6;
  material.phong_exponent = exponent;
  return material;
}

Scene octahedron(double exponent) {
  Scene scene;
  Mesh mesh;
  for (int k = 0; k < 3; ++k) {
    mesh.vertices.push_back(Vec3::Unit(k));
    mesh.vertices.push_back(-Vec3::Unit(k));
  }
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t x = octant & 1U, y = 2 + ((octant >> 1) & 1U), z = 4 + ((octant >> 2) & 1U);
    const bool odd = std::popcount(octant) % 2 != 0;
    mesh.triangles.push_back({x, odd ? z : y, odd ? y : z});
  }
  add(scene, mesh, glossy(exponent), "octahedron");
  scene.ambient = {0.2, 0.3, 0.4};
  scene.background = {-1, -1, -1};
  scene.camera.eye = {3, 2, 1.5};
  scene.camera.gaze = -scene.camera.eye;
  scene.camera.horizontal_half_angle = 0.33;
  scene.camera.columns = 96;
  scene.camera.rows = 80;
  scene.lights = {PointLight{{4, -1, 3}, {0.7, 0.6, 0.5}}, DirectionalLight{Vec3(1, 2, 2) / 3, {0.3, 0.4, 0.5}}};
  return scene;
}

ShadingOptions smooth(Shading shading) {
  ShadingOptions options;
  options.shading = shading;
  options.net.crease_angle = std::numbers::pi;
  options.samples = 1;
  return options;
}

/// Where a light of the octahedron's scene is seen from a point: written out, for these two lights.
struct Seen {
  Vec3 to_light;
  Rgb intensity;
};
std::vector<Seen> lights_at(const Scene& scene, const Vec3& point) {
  std::vector<Seen> all;
  for (const Light& light : scene.lights) {
    if (const auto* p = std::get_if<PointLight>(&light))
      all.push_back({(p->position - point).normalized(), p->intensity});
    if (const auto* d = std::get_if<DirectionalLight>(&light)) all.push_back({d->direction, d->intensity});
  }
  return all;
}

struct Products {
  double incidence, mirror;
};
Products products(const Vec3& n, const Vec3& l, const Vec3& v) {
  return {n.dot(l), (2 * n.dot(l) * n - l).dot(v)};
}

/// Equation 2-7 without attenuation, from the two products of each light.
Rgb equation(const Scene& scene, const std::vector<Products>& of, const std::vector<Seen>& lights) {
  const Material& m = scene.materials[0];
  Rgb sum = m.k_a * scene.ambient;
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (of[i].incidence <= 0) continue;
    sum += lights[i].intensity *
           (m.k_d * of[i].incidence + m.k_s * std::pow(std::max(of[i].mirror, 0.0), m.phong_exponent));
  }
  return sum;
}

Rgb equation(const Scene& scene, const Vec3& point, const Vec3& normal) {
  std::vector<Products> of;
  const auto lights = lights_at(scene, point);
  for (const Seen& light : lights)
    of.push_back(products(normal, light.to_light, (scene.camera.eye - point).normalized()));
  return equation(scene, of, lights);
}

/// The point of the octahedron at a place of the picture [pixels], by IU.5.2 written out: the nearest of its eight planes' meetings.
std::optional<Vec3> met(const Camera& camera, double column, double row) {
  const Vec3 g = camera.gaze.normalized(), x = g.cross(camera.up).normalized(), y = x.cross(g);
  const double tan_h = std::tan(camera.horizontal_half_angle), tan_v = tan_h * camera.rows / camera.columns;
  const Vec3 d = g + (2 * column / camera.columns - 1) * tan_h * x + (1 - 2 * row / camera.rows) * tan_v * y;
  double nearest = 1e9;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 s((octant & 1) ? -1 : 1, (octant & 2) ? -1 : 1, (octant & 4) ? -1 : 1);
    const double t = (1 - s.dot(camera.eye)) / s.dot(d);
    const Vec3 p = camera.eye + t * d;
    if (t > 0 && t < nearest && s.cwiseProduct(p).minCoeff() >= -1e-12) nearest = t;
  }
  if (nearest == 1e9) return std::nullopt;
  return Vec3(camera.eye + nearest * d);
}

/// What the text's method gives at a point of the octahedron.
Rgb shaded(const Scene& scene, Shading shading, const Vec3& p) {
  const Vec3 s(p.x() < 0 ? -1 : 1, p.y() < 0 ? -1 : 1, p.z() < 0 ? -1 : 1);
  const Vec3 weight = s.cwiseProduct(p);
  if (shading == Shading::flat) return equation(scene, s / 3, s / std::sqrt(3.0));
  if (shading == Shading::phong) return equation(scene, p, p.normalized());
  Rgb sum = Rgb::Zero();
  std::vector<Products> of(scene.lights.size(), {0, 0});
  for (int k = 0; k < 3; ++k) {
    const Vec3 corner = s[k] * Vec3::Unit(k);
    sum += weight[k] * equation(scene, corner, corner);
    const auto lights = lights_at(scene, corner);
    for (std::size_t i = 0; i < of.size(); ++i) {
      const auto at = products(corner, lights[i].to_light, (scene.camera.eye - corner).normalized());
      of[i].incidence += weight[k] * at.incidence;
      of[i].mirror += weight[k] * at.mirror;
    }
  }
  return shading == Shading::gouraud ? sum : equation(scene, of, lights_at(scene, p));
}

// CLAIM      IU.3.1, IU.3.2b, IU.3.3, IU.3.4: with each method every pixel shows what the text's formula gives at the point of the
//            surface that its centre meets: one intensity a facet; intensities, renormalised normals, or scalar products
//            interpolated between the corners, whose normals are averages (IU.3.2a).
// ORACLE     known render: the formulas, written out, at the intersections of rays with the octahedron.
// TOLERANCE  corners are snapped by half of 1/4096 pixel: twice what the formula changes by over 1/4096 pixel to four sides, and
//            1e-12 for its rounding. Pixels whose facet changes within 1/512 pixel are set aside: at most 2 %.
TEST(ShadedView, ShowsWhatTheFormulasSay) {
  proves({"IU.3.1", "IU.3.2a", "IU.3.2b", "IU.3.3", "IU.3.4"}, Oracle::render, "an octahedron, pixel by pixel");
  std::uint64_t pixels = 0, aside = 0, wrong = 0, outside = 0;
  for (const double exponent : {1.0, 8.0, 30.0}) {
    const Scene scene = octahedron(exponent);
    for (const Shading shading : kAllShadings) {
      const auto view = view_shaded(scene, smooth(shading));
      ASSERT_TRUE(view.ok());
      for (int row = 0; row < scene.camera.rows; ++row) {
        for (int column = 0; column < scene.camera.columns; ++column) {
          const auto at = [&](double dx, double dy) { return met(scene.camera, column + 0.5 + dx, row + 0.5 + dy); };
          const auto here = at(0, 0);
          const auto facet = [](const std::optional<Vec3>& p) {
            return p ? (p->x() < 0) + 2 * (p->y() < 0) + 4 * (p->z() < 0) : -1;
          };
          bool edge = false;
          double change = 0;
          for (const auto& [dx, dy] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
            edge = edge || facet(at(dx / 512, dy / 512)) != facet(here);
            const auto beside = at(dx / 4096, dy / 4096);
            if (here && beside)
              change =
                  std::max(change, (shaded(scene, shading, *beside) - shaded(scene, shading, *here)).abs().maxCoeff());
          }
          ++pixels;
          if (edge) {
            ++aside;
            continue;
          }
          const Rgb& shown = view->image.at(column, row);
          wrong += (shown[0] == -1) == here.has_value();
          outside += !here;
          if (!here) continue;
          const double error = (shown - shaded(scene, shading, *here)).abs().maxCoeff();
          EXPECT_TRUE(within(error, 2 * change + 1e-12)) << column << " " << row << " " << static_cast<int>(shading);
        }
      }
    }
  }
  EXPECT_LT(aside, pixels / 50);
  EXPECT_GT(outside, 10000u);
  EXPECT_TRUE(all_agree(wrong, pixels - aside));
}

/// Eye and one light far along (1, 1, 1), before the middle of a facet; nothing but the highlight.
Scene facing(double exponent, const Vec3& direction) {
  Scene scene = octahedron(exponent);
  scene.materials[0].k_d = scene.materials[0].k_a = Rgb::Zero();
  scene.materials[0].k_s = 1;
  scene.camera.eye = 40 * direction.normalized();
  scene.camera.gaze = -scene.camera.eye;
  scene.camera.horizontal_half_angle = 0.03;
  scene.camera.columns = scene.camera.rows = 61;
  scene.lights = {DirectionalLight{direction.normalized(), Rgb::Ones()}};
  return scene;
}

double brightest(const Image& image) {
  double most = 0;
  for (const Rgb& pixel : image.pixels) most = std::max(most, pixel.maxCoeff());
  return most;
}

// CLAIM      IU.3.2.1c: a highlight inside a polygon is lost by Gouraud's method and kept by interpolating normals.
// ORACLE     closed form: in the middle of the facet N = L = V, so 1; at its corners R·V is 2/3 − 1 < 0, so nothing.
// TOLERANCE  1e-3: the middle of the picture is a pixel's centre, snapping moves it by a 4096th of 1/30 radians or so.
TEST(ShadedView, KeepsHighlightsInsidePolygonsByNormals) {
  proves({"IU.3.2.1c", "IU.3.3"}, Oracle::closed_form, "N = L = V in the middle of a facet");
  for (const double exponent : {10.0, 100.0}) {
    const Scene scene = facing(exponent, {1, 1, 1});
    EXPECT_TRUE(near(view_shaded(scene, smooth(Shading::phong))->image.at(30, 30)[0], 1, 1e-3));
    EXPECT_TRUE(within(brightest(view_shaded(scene, smooth(Shading::gouraud))->image), 1e-12));
  }
}

// CLAIM      G4: interpolated normals must be made unit vectors again. Half way between normals at 90° the interpolated one has the
//            length 0.7071: the power 100 of its cosine is 8.9e-16 where the highlight should be 1, and by 2-7, whose R then is no
//            mirror direction, R·V = 0.
// ORACLE     closed form: the middle of an edge of the octahedron, seen and lit along its normal.
// TOLERANCE  1e-3 for the picture, as above; 2e-16 for the printed products.
TEST(ShadedView, MakesInterpolatedNormalsUnitVectors) {
  proves({"G4", "IU.3.3"}, Oracle::closed_form, "half way between normals at a right angle");
  const Vec3 half = 0.5 * Vec3::UnitX() + 0.5 * Vec3::UnitY(), direction = half.normalized();
  EXPECT_TRUE(apart(std::pow(half.dot(direction), 100), 1, 0.9));
  EXPECT_TRUE(near(std::pow(half.dot(direction), 100), 0x1p-50, 0x1p-60));
  EXPECT_TRUE(within(std::abs(products(half, direction, direction).mirror), 4e-16));
  const Scene scene = facing(100, {1, 1, 0});
  const auto view = view_shaded(scene, smooth(Shading::phong));
  EXPECT_TRUE(near(view->image.at(30, 30)[0], 1, 1e-3));
}

// CLAIM      E30, IU.3.4: interpolating (R·V)ⁿ, as printed, is Gouraud's method: where N·L and the power are interpolated the picture
//            is a sum of interpolated numbers. Interpolating R·V, and taking the power at the pixel, is not.
// ORACLE     identity: the printed form written out at every pixel against the picture by Gouraud's method.
// TOLERANCE  printed against Gouraud as in ShowsWhatTheFormulasSay, with one light that no facet is turned away from; the mended form
//            is apart by 0.02 somewhere.
TEST(ShadedView, InterpolatesProductsBeforeTheirPower) {
  proves({"E30", "IU.3.4"}, Oracle::identity, "the printed form against Gouraud's, pixel by pixel");
  Scene scene = octahedron(2);
  scene.lights = {DirectionalLight{Vec3(3, 0.3, 0.3).normalized(), {0.7, 0.6, 0.5}}};
  const auto gouraud = view_shaded(scene, smooth(Shading::gouraud)), dot = view_shaded(scene, smooth(Shading::dot));
  const Material& m = scene.materials[0];
  const auto& light = std::get<DirectionalLight>(scene.lights[0]);
  double most = 0;
  std::uint64_t compared = 0;
  for (int row = 0; row < scene.camera.rows; ++row) {
    for (int column = 0; column < scene.camera.columns; ++column) {
      const auto p = met(scene.camera, column + 0.5, row + 0.5);
      const Rgb& shown = gouraud->image.at(column, row);
      if (!p || shown[0] == -1 || p->minCoeff() < 0.01) continue;  // inside the facet that all light falls on
      double incidence = 0, power = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3 v = (scene.camera.eye - Vec3::Unit(k)).normalized();
        const auto at = products(Vec3::Unit(k), light.direction, v);
        incidence += (*p)[k] * at.incidence;
        power += (*p)[k] * std::pow(std::max(at.mirror, 0.0), m.phong_exponent);
      }
      const Rgb printed = m.k_a * scene.ambient + light.intensity * (m.k_d * incidence + m.k_s * power);
      EXPECT_TRUE(within((printed - shown).abs().maxCoeff(), 1e-5));  // a 4096th of a pixel, 80 of which are 2 units
      most = std::max(most, (dot->image.at(column, row) - printed).abs().maxCoeff());
      ++compared;
    }
  }
  EXPECT_GT(compared, 500u);
  EXPECT_TRUE(apart(most, 0, 0.02));
}

/// A ball of k_d and no highlight in front of the eye, lit from the side.
Scene ball() {
  Scene scene;
  add(scene, Sphere{{0, 0, 0}, 1}, diffuse(0.8), "ball");
  scene.camera.eye = {0, -20, 0};
  scene.camera.gaze = {0, 1, 0};
  scene.camera.horizontal_half_angle = 0.06;
  scene.camera.columns = scene.camera.rows = 400;
  scene.lights = {DirectionalLight{Vec3(1, -1, 0.5).normalized(), Rgb::Ones()}};
  return scene;
}

// CLAIM      IU.3.1.1: jumps of intensity, and of its slope, are perceived enlarged; by every measure of the jumps along a scan line
//            of a sphere's net flat shading is worse than Gouraud's and that worse than Phong's.
// ORACLE     metamorphic: the order of the measures, for three nets and three scan lines, by factors.
// TOLERANCE  flat: jumps of intensity five times Gouraud's, of slope and perceived ones too. Gouraud: slope and perceived jumps 1.2
//            times Phong's.
TEST(ShadedView, HasFewerMachBandsTheMoreIsInterpolated) {
  proves({"IU.3.1.1"}, Oracle::metamorphic, "flat > Gouraud > Phong on a sphere, by three measures");
  const Scene scene = ball();
  for (const int facets : {12, 16, 24}) {
    for (const int row : {140, 190, 230}) {
      const auto measured = [&](Shading shading) {
        ShadingOptions options = smooth(shading);
        options.net.facets = facets;
        return jumps(scan_line(view_shaded(scene, options)->image, row, 130, 330).intensities);
      };
      const Jumps flat = measured(Shading::flat), gouraud = measured(Shading::gouraud),
                  phong = measured(Shading::phong);
      EXPECT_TRUE(within(5 * gouraud.intensity, flat.intensity));
      EXPECT_TRUE(within(5 * gouraud.slope, flat.slope));
      EXPECT_TRUE(within(5 * gouraud.perceived, flat.perceived));
      EXPECT_TRUE(within(1.2 * phong.slope, gouraud.slope)) << facets << " " << row;
      EXPECT_TRUE(within(1.2 * phong.perceived, gouraud.perceived)) << facets << " " << row;
    }
  }
}

// CLAIM      Facets are shaded on the viewer's side, whichever way they are wound.
// ORACLE     metamorphic: the octahedron turned inside out.
// TOLERANCE  1e-9: the corners of a facet come in another order, its pixels' weights with other roundings, n at most 8.
TEST(ShadedView, DoesNotAskHowFacetsAreWound) {
  proves({"IU.3.2a"}, Oracle::metamorphic, "the octahedron turned inside out");
  Scene scene = octahedron(8);
  for (const Shading shading : kAllShadings) {
    const auto before = view_shaded(scene, smooth(shading));
    Scene turned = scene;
    for (auto& triangle : std::get<Mesh>(turned.objects[0].shape).triangles) std::swap(triangle[0], triangle[1]);
    const auto after = view_shaded(turned, smooth(shading));
    double most = 0;
    for (std::size_t i = 0; i < before->image.pixels.size(); ++i)
      most = std::max(most, (before->image.pixels[i] - after->image.pixels[i]).abs().maxCoeff());
    EXPECT_TRUE(within(most, 1e-9));
  }
}

// CLAIM      What is flat is shown as by rays, also where it reaches behind the eye and is cut off: with a light in the eye, so that no
//            shadow is seen.
// ORACLE     independent method: the ray tracer, one ray a pixel, the same scene.
// TOLERANCE  2e-3, the change of intensity over a few 4096ths of a pixel at most; at edges and at the horizon, 2 % of the pixels at most,
//            centres may be snapped to another side.
TEST(ShadedView, AgreesWithRaysOnFlatShapes) {
  proves({"IU.3.3", "IU.5.2"}, Oracle::program, "the ray tracer, pixel by pixel");
  Scene scene;
  add(scene, square({0, 0, 0}, Vec3::UnitZ(), 30), glossy(5), "floor");
  add(scene, Box{{4, 6, 1}, Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()).toRotationMatrix(), {1, 0.7, 1.5}},
      glossy(20), "box");
  add(scene, Disc{{-3, 7, 2}, Vec3(1, -1, 0.3).normalized(), 1.2}, diffuse(0.7), "disc");
  scene.ambient = {0.2, 0.2, 0.3};
  scene.camera.eye = {0.3, -0.2, 1.5};
  scene.camera.gaze = {0.1, 1, -0.25};
  scene.camera.horizontal_half_angle = 0.9;
  scene.camera.columns = 120;
  scene.camera.rows = 90;
  scene.lights = {PointLight{scene.camera.eye, {0.5, 0.6, 0.7}}};
  ShadingOptions options;
  options.samples = 1;
  options.net.facets = 256;
  const Image drawn = view_shaded(scene, options)->image;
  RenderOptions rays;
  rays.sampling.samples_per_side = 1;
  const Image traced = render(*make_accelerator(scene, AcceleratorKind::bounding_volumes), rays, {}).value().image;
  std::size_t edges = 0, floor = 0;
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    const double error = (drawn.pixels[i] - traced.pixels[i]).abs().maxCoeff();
    floor += traced.pixels[i].maxCoeff() > 0;
    if (error > 2e-3) {
      ++edges;
    } else {
      EXPECT_TRUE(within(error, 2e-3));
    }
  }
  EXPECT_TRUE(within(static_cast<double>(edges), 0.02 * static_cast<double>(drawn.pixels.size())));
  EXPECT_GT(floor, drawn.pixels.size() / 2);
}

// CLAIM      The same bits for any number of threads, in a scene that reaches behind the eye; and what is left out is said.
// ORACLE     metamorphic: one thread against three.
// TOLERANCE  none.
TEST(ShadedView, HasTheSameBitsWithAnyNumberOfThreads) {
  proves({}, Oracle::metamorphic, "one thread against three");
  Scene scene = octahedron(5);
  add(scene, square({0, 0, -1.2}, Vec3::UnitZ(), 50), specular(0.5, 0.2, 1.5), "floor");
  scene.materials[0].name = "gloss";
  scene.materials[1].name = "glass";
  ShadingOptions options;
  options.samples = 2;
  const auto one = view_shaded(scene, options, {1, {}, nullptr}), three = view_shaded(scene, options, {3, {}, nullptr});
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < one->image.pixels.size(); ++i)
    wrong += (one->image.pixels[i] != three->image.pixels[i]).any();
  EXPECT_TRUE(all_agree(wrong, one->image.pixels.size()));
  const std::vector<std::string> expected{"reflection (k_r of 'glass')", "refraction (k_t of 'glass')", "shadows"};
  EXPECT_TRUE(holds(left_out(scene) == expected));
}

}  // namespace
}  // namespace etendue::validation
